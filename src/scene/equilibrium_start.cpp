#include "scene/equilibrium_start.h"

#include <fmt/format.h>

#include <memory>

#include "analysis/equilibria.h"
#include "messages/input_error.h"

namespace whirl_twin {

namespace {

/// For a system without a motor.
std::optional<Equilibrium> equilibriumFromZero(const Dynamics& dynamics, double speed) {
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(dynamics.dof());
  // For a shaft, one path leads from the line of its bearings to the equilibrium: the stability
  // analysis of a long one takes long and would not change the result.
  const bool shaft = dynamics.isRotor() && dynamics.dof() > 2;
  if (!dynamics.linear() && !shaft) {
    if (auto point = operatingPoint(dynamics, zero, zero, speed)) {
      return point;
    }
  }
  const auto q = equilibriumNear(dynamics, zero, speed);
  return q ? std::optional<Equilibrium>({*q, zero, {}}) : std::nullopt;
}

}  // namespace

std::optional<StartingState> equilibriumStart(const ModelInfo& model, const SystemSpec& spec,
                                              const ModelSetup& setup, const ModelContext& around,
                                              double speed) {
  std::shared_ptr<const Dynamics> held = setup.dynamics;
  if (around.motor) {
    ModelContext without = around;
    without.motor.reset();
    held = model.setUp(spec.parameters, spec.settings, without).dynamics;
  }
  const std::optional<Equilibrium> found = equilibriumFromZero(*held, speed);
  if (!found || !found->q.allFinite()) {
    return std::nullopt;
  }
  StartingState start{{found->q.data(), found->q.data() + found->q.size()},
                      {found->v.data(), found->v.data() + found->v.size()}};
  start.q.resize(static_cast<std::size_t>(setup.dynamics->dof()), 0.0);
  start.v.resize(start.q.size(), 0.0);
  return start;
}

bool startsAtEquilibrium(const SystemSpec& spec, const ModelSetup& setup,
                         const ModelContext& around) {
  const auto choice = spec.settings.choices.find("gravity_on_shaft");
  return setup.dynamics->isRotor() && around.gravity != 0.0 &&
         choice != spec.settings.choices.end() && choice->second == "true";
}

void moveToEquilibrium(const SystemSpec& given, const std::optional<StartingState>& own,
                       const ModelContext& around, SystemSpec& member) {
  if (!given.rest) {
    return;
  }
  if (!own && given.rest->asked) {
    throw InputError(
        fmt::format("no equilibrium to start at was found at {:g} rad/s", given.rest->speed));
  }
  const std::size_t shape = given.q.size() - (around.motor ? 1 : 0);
  for (std::size_t i = 0; i < shape; ++i) {
    member.q[i] += (own ? own->q[i] : 0.0) - given.q[i];
    member.v[i] += (own ? own->v[i] : 0.0) - given.v[i];
  }
}

}  // namespace whirl_twin
