#include "twin/twin.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "models/model_registry.h"
#include "scene/scene_reader.h"
#include "scene/surroundings.h"

namespace whirl_twin {

namespace {

/// "x [m], theta [rad]"
std::string coordinateNames(const Dynamics& dynamics) {
  std::string names;
  for (const CoordinateInfo& c : dynamics.coordinates()) {
    names += fmt::format("{}{} [{}]", names.empty() ? "" : ", ", c.name, c.unit);
  }
  return names;
}

}  // namespace

Twin::Twin(const Scene& scene) : scene_(scene) {
  drives_.reserve(scene.drives.size() + scene.systems.size());  // systems keep references to them
  for (const DriveSpec& d : scene.drives) {
    drives_.emplace_back(d.speed, d.angle, d.profile, scene.time);
  }
  for (const SystemSpec& spec : scene.systems) {
    Member member = memberOf(spec);
    if (spec.drive) {
      member.drive = scene.driveOf(spec);
      if (member.drive == scene.drives.size()) {
        throw std::invalid_argument("no drive named " + *spec.drive);
      }
    } else {
      member.drive = drives_.size();
      drives_.emplace_back(spec.speed.value_or(0.0), 0.0);
    }
    try {
      systems_.push_back(stepperOf(member));
    } catch (const std::domain_error& error) {
      throw SceneError({fmt::format("{}: systems.{}: {}", scene.source, spec.name, error.what())});
    }
    members_.push_back(std::move(member));
  }
  turned_by_.assign(drives_.size(), kNoSystem);
  for (std::size_t i = 0; i < members_.size(); ++i) {
    const std::size_t drive = members_[i].drive;
    if (drive < scene.drives.size() && scene.drives[drive].motor) {
      turned_by_[drive] = i;
    }
  }
  status_.resize(systems_.size());
  replacements_.resize(systems_.size());
  running_.resize(systems_.size());
  generation_.resize(systems_.size());
  ensembles_.resize(systems_.size());
  layout_.size = RecordLayout::kDrives + RecordLayout::kDriveSize * drives_.size();
  for (const auto& system : systems_) {
    layout_.system.push_back(layout_.size);
    layout_.size += 4 + 2 * system->dof();
    state_.resize(std::max(state_.size(), 2 * system->dof() + 1));
  }
  reset();
}

void Twin::buildEnsembles() {
  for (std::size_t i = 0; i < members_.size(); ++i) {
    const Member& member = members_[i];
    if (member.spec.ensemble.count == 0) {
      continue;
    }
    try {
      ensembles_[i] = std::make_unique<Ensemble>(scene_, member.spec, *member.model,
                                                 member.integrator, drives_[member.drive]);
    } catch (const std::logic_error& error) {  // invalid arguments and domains
      throw SceneError({fmt::format("{}: systems.{}.spread: {}", scene_.source, member.spec.name,
                                    error.what())});
    }
  }
  reset();
}

Twin::Member Twin::memberOf(const SystemSpec& spec) const {
  const ModelInfo* model = findModel(spec.model);
  if (model == nullptr) {
    throw std::invalid_argument("no model named " + spec.model);
  }
  Member member{spec,
                model,
                model->setUp(spec.parameters, spec.settings, surroundingsOf(scene_, spec)),
                {},
                spec.integrator,
                "",
                0};
  member.dynamics = member.setup.dynamics;
  if (spec.integrator == "auto") {
    const bool on_drive = spec.drive.has_value();
    // A choice made for other parameters may not suit these.
    if (canStepWith(member.setup, on_drive, spec.chosen_integrator)) {
      member.integrator = spec.chosen_integrator;
      member.integrator_reason = spec.choice_reason;
    } else {
      const IntegratorChoice choice = chooseIntegrator(member.setup, on_drive);
      member.integrator = choice.integrator;
      member.integrator_reason = choice.reason;
    }
  }
  return member;
}

std::unique_ptr<Stepper> Twin::stepperOf(const Member& member) const {
  return member.setup.system(member.integrator, drives_[member.drive], scene_.stepSeconds(),
                             member.spec.substeps);
}

Twin::Member Twin::changed(std::size_t system, const SystemSpec& spec) const {
  if (spec.ensemble.count > 0) {
    throw std::invalid_argument(
        "are those of an ensemble, drawn at the start: they cannot be changed while it runs");
  }
  Member member = memberOf(spec);
  member.drive = members_[system].drive;
  const std::string names = coordinateNames(*member.dynamics);
  const std::string before = coordinateNames(*members_[system].dynamics);
  if (names != before || member.dynamics->isRotor() != members_[system].dynamics->isRotor()) {
    throw std::invalid_argument(
        fmt::format("would change the coordinates from {} to {}: that needs a new start with "
                    "another scene",
                    before, names));
  }
  const std::string objection =
      integratorObjection(member.setup, spec.drive.has_value(), spec.integrator);
  if (!objection.empty()) {
    throw std::invalid_argument("integrator: " + objection);
  }
  return member;
}

double Twin::seconds(std::int64_t steps) const noexcept {
  return static_cast<double>(scene_.time + steps * scene_.step) / 1.0e9;
}

void Twin::step() noexcept {
  const double time = this->time();
  for (std::size_t i = 0; i < systems_.size(); ++i) {
    if (status_[i] == StepStatus::kOk) {
      status_[i] = running_[i]->step(time);
    }
  }
  for (const std::unique_ptr<Ensemble>& ensemble : ensembles_) {
    if (ensemble) {
      ensemble->step(time);
    }
  }
  ++steps_;
  for (Drive& drive : drives_) {
    drive.begin(scene_.time + steps_ * scene_.step);
  }
  for (const std::unique_ptr<Ensemble>& ensemble : ensembles_) {
    if (ensemble) {
      ensemble->publish(steps_);
    }
  }
}

void Twin::reset() noexcept {
  steps_ = 0;
  for (Drive& drive : drives_) {
    drive.reset();
    drive.begin(scene_.time);
  }
  for (std::size_t i = 0; i < systems_.size(); ++i) {
    running_[i] = systems_[i].get();
    generation_[i] = 0;
    running_[i]->set(members_[i].spec.q.data(), members_[i].spec.v.data());
    status_[i] = StepStatus::kOk;
    if (ensembles_[i]) {
      ensembles_[i]->reset();
      ensembles_[i]->publish(0);
    }
  }
}

std::unique_ptr<Stepper> Twin::replace(std::size_t system, std::unique_ptr<Stepper> next,
                                       std::int64_t generation) noexcept {
  running_[system]->write(state_.data());
  next->set(state_.data(), state_.data() + next->dof());
  running_[system] = next.get();
  generation_[system] = generation;
  replacements_[system].swap(next);
  return next;
}

void Twin::write(double* record) const noexcept {
  record[RecordLayout::kStep] = packed(steps_);
  double* out = record + RecordLayout::kDrives;
  for (std::size_t i = 0; i < drives_.size(); ++i) {
    ShaftState shaft;
    if (isMotor(i) && running_[turned_by_[i]]->shaft(shaft)) {
      out[4] = 0.0;
      out[5] = shaft.speed;
    } else {
      const ShaftMotion motion = drives_[i].at(0.0);
      shaft = {drives_[i].angle(), motion.speed, motion.acceleration};
      out[4] = motion.jerk;
      out[5] = drives_[i].targetSpeed();
    }
    out[0] = packed(shaft.angle.turns);
    out[1] = shaft.angle.remainder;
    out[2] = shaft.speed;
    out[3] = shaft.acceleration;
    out += RecordLayout::kDriveSize;
  }
  for (std::size_t i = 0; i < systems_.size(); ++i) {
    record[layout_.system[i]] = packed(static_cast<std::int64_t>(status_[i]));
    running_[i]->write(record + layout_.system[i] + 1);
    record[layout_.system[i] + 2 + 2 * running_[i]->dof()] = packed(generation_[i]);
    record[layout_.system[i] + 3 + 2 * running_[i]->dof()] = running_[i]->errorSum();
  }
}

bool Twin::setSpeed(std::size_t drive, double speed, double max_acceleration,
                    double max_jerk) noexcept {
  return drive < scene_.drives.size() && !isMotor(drive) &&
         drives_[drive].setSpeed(speed, max_acceleration, max_jerk);
}

const char* describe(StepStatus status) {
  switch (status) {
    case StepStatus::kNotFinite:
      return "state not finite";
    case StepStatus::kNotConverged:
      return "implicit step did not converge";
    case StepStatus::kOutOfRange:
      return "its shaft runs at a speed that it was not prepared for";
    case StepStatus::kOk:
      break;
  }
  return "";
}

}  // namespace whirl_twin
