#include "twin/ensemble.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <new>
#include <optional>
#include <utility>

#include "analysis/natural_modes.h"
#include "messages/input_error.h"
#include "models/model_registry.h"
#include "scene/ensemble_draw.h"
#include "scene/equilibrium_start.h"
#include "twin/ensemble_members.h"

namespace whirl_twin {

namespace {

constexpr double kRecordPeriod = 0.02;  // s, simulated

std::vector<EnsembleQuantity> quantitiesOf(const Dynamics& dynamics) {
  if (dynamics.isRotor()) {
    return {{"radius", "m"}};
  }
  std::vector<EnsembleQuantity> quantities;
  for (const CoordinateInfo& c : dynamics.coordinates()) {
    quantities.push_back({c.name, c.unit});
  }
  return quantities;
}

InputError refused(std::size_t member, const std::exception& error) {
  return InputError(fmt::format("sample {}: {}", member, error.what()));
}

/// A varied parameter with nominal value 0 may switch a sample to a different form of its model.
void requireSameKind(const Dynamics& given, const ModelSetup& setup, const SystemSpec& spec,
                     const std::string& integrator) {
  const auto names = [](const Dynamics& dynamics) {
    std::vector<std::string> all;
    for (const CoordinateInfo& c : dynamics.coordinates()) {
      all.push_back(c.name);
    }
    return all;
  };
  if (names(given) != names(*setup.dynamics) || given.isRotor() != setup.dynamics->isRotor()) {
    throw InputError("has other coordinates than the nominal system");
  }
  if (!canStepWith(setup, spec.drive.has_value(), integrator)) {
    throw InputError(fmt::format("cannot be stepped with {}", integrator));
  }
  const auto vector = [](const std::vector<double>& values) {
    return Eigen::Map<const Eigen::VectorXd>(values.data(),
                                             static_cast<Eigen::Index>(values.size()));
  };
  if (massIsSingular(*setup.dynamics, vector(spec.q), vector(spec.v),
                     {0.0, 0.0, spec.speed.value_or(0.0), 0.0})) {
    throw InputError("its mass matrix is singular at the start");
  }
}

/// Equilibrium at the first station [m].
Eigen::Vector2d restAt(const Dynamics& dynamics, const std::optional<StartingState>& rest) {
  if (!rest) {
    return Eigen::Vector2d::Zero();
  }
  const Station station = dynamics.stations().front();
  const Eigen::Map<const Eigen::VectorXd> q(rest->q.data(), station.along_x.size());
  return {station.along_x.dot(q), station.along_y.dot(q)};
}

}  // namespace

Ensemble::Ensemble(const Scene& scene, const BuiltSystem& system, const StepContext& excitation)
    : count_(system.spec.ensemble.count),
      quantities_(quantitiesOf(*system.dynamics)),
      every_(std::max<std::int64_t>(1, std::llround(kRecordPeriod / scene.stepSeconds()))),
      latest_(recordSize()) {
  const SystemSpec& given = system.spec;
  const ModelContext& around = given.setup->around;
  const double speed = given.rest ? given.rest->speed : excitation.drive.at(0.0).speed;
  const auto equilibrium = [&](const SystemSpec& spec,
                               const ModelSetup& setup) -> std::optional<StartingState> {
    try {
      if (given.rest || setup.dynamics->isRotor()) {
        return equilibriumStart(*system.model, spec, setup, around, speed);
      }
    } catch (const std::bad_alloc&) {
      throw;
    } catch (const std::exception&) {
      // Values beyond the range of double, or a singular mass matrix: no equilibrium.
    }
    return std::nullopt;
  };
  if (system.dynamics->isRotor()) {
    rest_ = restAt(*system.dynamics, equilibrium(given, given.setup->made));
  }
  std::vector<EnsembleMember> members;
  for (std::size_t i = 0; i < count_; ++i) {
    try {
      DrawnMember member = drawnMember(given, *system.model, i);
      ModelSetup setup = system.model->setUp(member.spec.parameters, member.spec.settings, around);
      requireSameKind(*system.dynamics, setup, member.spec, system.integrator);
      const auto own = equilibrium(member.spec, setup);
      moveToEquilibrium(given, own, around, member.spec);
      drawn_.push_back(std::move(member.values));
      const Eigen::Vector2d rest =
          setup.dynamics->isRotor() ? restAt(*setup.dynamics, own) : Eigen::Vector2d::Zero();
      members.push_back({std::move(member.spec), std::move(setup), rest});
    } catch (const InputError& error) {
      throw refused(i, error);
    }
  }
  steps_ = ensembleSteps(members, system.integrator, excitation, scene.stepSeconds());
}

void Ensemble::reset() noexcept {
  steps_->reset();
}

void Ensemble::write(std::int64_t step, double* record) const noexcept {
  record[kStep] = packed(step);
  double* const values = record + kValues;
  steps_->write(values, values + numbers());
}

void Ensemble::publish(std::int64_t step) noexcept {
  if (step % every_ == 0) {
    write(step, latest_.room());
    latest_.publish();
  }
}

}  // namespace whirl_twin
