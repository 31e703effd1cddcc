#include "scene/twin.h"

#include <algorithm>
#include <stdexcept>

#include "scene/model_registry.h"

namespace whirl_twin {

namespace {

std::size_t driveIndex(const Scene& scene, const std::string& name) {
  const auto found = std::find_if(scene.drives.begin(), scene.drives.end(),
                                  [&](const DriveSpec& d) { return d.name == name; });
  if (found == scene.drives.end()) {
    throw std::invalid_argument("no drive named " + name);
  }
  return static_cast<std::size_t>(found - scene.drives.begin());
}

}  // namespace

Twin::Twin(const Scene& scene) : scene_(scene) {
  drives_.reserve(scene.drives.size() + scene.systems.size());  // systems keep references to them
  for (const DriveSpec& d : scene.drives) {
    drives_.emplace_back(d.speed, d.angle, d.profile, scene.time);
  }
  for (const SystemSpec& spec : scene.systems) {
    const ModelInfo* model = findModel(spec.model);
    if (model == nullptr) {
      throw std::invalid_argument("no model named " + spec.model);
    }
    Member member{spec, model, model->setUp(spec.parameters, spec.settings, scene.gravity), {}, "",
                  "",   0};
    member.dynamics = member.setup.dynamics;
    if (spec.drive) {
      member.drive = driveIndex(scene, *spec.drive);
    } else {
      member.drive = drives_.size();
      drives_.emplace_back(spec.speed.value_or(0.0), 0.0);
    }
    member.integrator = spec.integrator;
    if (spec.integrator == "auto") {
      const IntegratorChoice choice = chooseIntegrator(*member.dynamics, spec.drive.has_value());
      member.integrator = choice.integrator;
      member.integrator_reason = choice.reason;
    }
    systems_.push_back(member.setup.system(member.integrator, drives_[member.drive],
                                           scene.stepSeconds(), spec.substeps));
    members_.push_back(std::move(member));
  }
  status_.resize(systems_.size());
  layout_.size = RecordLayout::kDrives + RecordLayout::kDriveSize * drives_.size();
  for (const auto& system : systems_) {
    layout_.system.push_back(layout_.size);
    layout_.size += 2 + 2 * system->dof();
  }
  reset();
}

double Twin::seconds(std::int64_t steps) const noexcept {
  return static_cast<double>(scene_.time + steps * scene_.step) / 1.0e9;
}

void Twin::step() noexcept {
  const double time = this->time();
  for (std::size_t i = 0; i < systems_.size(); ++i) {
    if (status_[i] == StepStatus::kOk) {
      status_[i] = systems_[i]->step(time);
    }
  }
  ++steps_;
  for (Drive& drive : drives_) {
    drive.begin(scene_.time + steps_ * scene_.step);
  }
}

void Twin::reset() noexcept {
  steps_ = 0;
  for (Drive& drive : drives_) {
    drive.reset();
    drive.begin(scene_.time);
  }
  for (std::size_t i = 0; i < systems_.size(); ++i) {
    systems_[i]->set(members_[i].spec.q.data(), members_[i].spec.v.data());
    status_[i] = StepStatus::kOk;
  }
}

void Twin::write(double* record) const noexcept {
  record[RecordLayout::kStep] = packed(steps_);
  double* out = record + RecordLayout::kDrives;
  for (const Drive& drive : drives_) {
    const ShaftAngle angle = drive.angle();
    const ShaftMotion motion = drive.at(0.0);
    out[0] = packed(angle.turns);
    out[1] = angle.remainder;
    out[2] = motion.speed;
    out[3] = motion.acceleration;
    out[4] = motion.jerk;
    out[5] = drive.targetSpeed();
    out += RecordLayout::kDriveSize;
  }
  for (std::size_t i = 0; i < systems_.size(); ++i) {
    record[layout_.system[i]] = packed(static_cast<std::int64_t>(status_[i]));
    systems_[i]->write(record + layout_.system[i] + 1);
  }
}

bool Twin::setSpeed(std::size_t drive, double speed, double max_acceleration,
                    double max_jerk) noexcept {
  return drive < scene_.drives.size() && drives_[drive].setSpeed(speed, max_acceleration, max_jerk);
}

const char* describe(StepStatus status) {
  switch (status) {
    case StepStatus::kNotFinite:
      return "state not finite";
    case StepStatus::kNotConverged:
      return "implicit step did not converge";
    case StepStatus::kOk:
      break;
  }
  return "";
}

}  // namespace whirl_twin
