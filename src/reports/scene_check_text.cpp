#include <fmt/format.h>

#include <cmath>

#include "integration/step_methods.h"
#include "messages/names.h"
#include "reports/asked_cost.h"
#include "reports/scene_check.h"
#include "scene/drive_reader.h"
#include "scene/weak_passage.h"

namespace whirl_twin {

namespace {

std::string publishedText(const Published& published) {
  std::vector<std::string> topics;
  for (const PublishedTopic& topic : published.topics) {
    topics.push_back(fmt::format("{} ({})", topic.topic, topic.type));
  }
  return fmt::format("    published on {}, LCM {}\n", fmt::join(topics, ", "),
                     fmt::join(published.channels, ", "));
}

std::string avoidedText(const ExclusionBands& avoid) {
  std::vector<std::string> bands;
  for (const SpeedBand& band : avoid.bands()) {
    if (band.from > 0.0) {
      bands.push_back(fmt::format("{:.6g} to {:.6g} rad/s", band.from, band.to));
    }
  }
  return bands.empty()
             ? ""
             : fmt::format(
                   "    barred speeds {}, in both directions: passed at full acceleration\n",
                   fmt::join(bands, ", "));
}

std::string driveText(const DriveSpec& drive, const Published& published) {
  std::string out = fmt::format("  {}: {:g} rad/s", drive.name, drive.speed);
  out += drive.profile.empty()
             ? ", constant until set_speed changes it\n"
             : fmt::format(" at the start, a profile of {:.4g} s\n", profileDuration(drive));
  const std::vector<double> durations = changeDurations(drive);
  for (std::size_t i = 0; i < durations.size(); ++i) {
    const SpeedMove& move = drive.profile[i];
    out += fmt::format("    to {:g} rad/s in {:.4g} s (within {:g} rad/s^2{}), then {:g} s there\n",
                       move.speed, durations[i], move.max_acceleration,
                       move.max_jerk > 0.0 ? fmt::format(" and {:g} rad/s^3", move.max_jerk) : "",
                       move.dwell);
  }
  return out + avoidedText(ExclusionBands(drive.avoid)) + publishedText(published);
}

std::string costText(double cost, double preparation) {
  if (preparation > 0.0) {
    return fmt::format("not measured: preparing its steps takes about {}", inWords(preparation));
  }
  return std::isnan(cost) ? "not measured: it stops within the first steps"
                          : fmt::format("about {:.0f} ns", cost);
}

std::string inputText(const InputCheck& check) {
  const InputSignal& signal = check.signal;
  const std::string& unit = check.input.unit;
  switch (signal.kind) {
    case InputSignal::Kind::kHarmonic:
      return fmt::format("{:g} {} cos({:g} rad/s t {} {:g} rad)", signal.amplitude, unit,
                         signal.frequency, signal.phase < 0.0 ? "-" : "+", std::fabs(signal.phase));
    case InputSignal::Kind::kTable:
      return fmt::format("a table of {} values ({}), {}, from t = {:g} s to {:g} s",
                         signal.values.size(), unit,
                         signal.hold ? "zero-order hold" : "linear interpolation",
                         static_cast<double>(signal.instants.front()) / 1e9,
                         static_cast<double>(signal.instants.back()) / 1e9);
    case InputSignal::Kind::kControlled:
      return fmt::format("given by a controller ({})", unit);
    case InputSignal::Kind::kHeld:
    case InputSignal::Kind::kNone:
      break;
  }
  return fmt::format("{:g} {}", signal.value, unit);
}

std::string checkedControllerText(const Scene& scene, const ControllerSpec& controller,
                                  const Published& published) {
  const std::string jitter =
      controller.jitter == 0
          ? ""
          : fmt::format(", jitter up to {:g} s", static_cast<double>(controller.jitter) / 1e9);
  std::string out = fmt::format(
      "  {}: {} at {:g} Hz, {}{}\n    measures {}, acts on {}\n", controller.name, controller.type,
      controller.rate,
      controller.delay == 0
          ? "without delay"
          : fmt::format("delay {:g} s", static_cast<double>(controller.delay) / 1e9),
      jitter, fmt::join(controller.measured, ", "), fmt::join(controller.acted_on, ", "));
  out += avoidedText(ExclusionBands(avoidedBands(scene, controller)));
  for (const WeakPassage& passage : controller.weak_passages) {
    out += fmt::format(
        "    {} {}\n",
        passage.tried ? "attempts, with too little torque, the band" : "REFUSES the band",
        describe(passage));
  }
  return out + publishedText(published);
}

std::string checkedSystemText(const SystemCheck& system) {
  std::string coordinates;
  for (const CoordinateInfo& c : system.coordinates) {
    coordinates += fmt::format("{}{} ({})", coordinates.empty() ? "" : ", ", c.name, c.unit);
  }
  std::string out =
      fmt::format("  {}: {}, {}\n", system.name, system.model->name, system.model->summary);
  out +=
      fmt::format("    coordinates   {}: {} states\n", coordinates, 2 * system.coordinates.size());
  if (system.drive) {
    out += fmt::format("    shaft         driven by {}\n", *system.drive);
  } else if (system.speed) {
    out += fmt::format("    shaft         {:g} rad/s, constant\n", *system.speed);
  }
  if (system.shaft) {
    out += fmt::format("    its length    {:.6g} m, mass {:.6g} kg, with its discs {:.6g} kg\n",
                       system.shaft->length, system.shaft->mass, system.shaft->rotor_mass);
  }
  for (const std::string& warning : system.warnings) {
    out += fmt::format("    warning       {}\n", warning);
  }
  if (system.starts_at_rest) {
    out += fmt::format("    start         at its equilibrium{}\n",
                       system.sag ? ", sag " + text(*system.sag) : "");
  }
  for (const InputCheck& input : system.inputs) {
    out += fmt::format("    input         {}: {}\n", input.input.name, inputText(input));
  }
  if (!system.note.empty()) {
    out += fmt::format("    set up        {}\n", system.note);
  }
  out += fmt::format("    integrator    {} ({}), {}\n", system.integrator, system.reason,
                     stepsText(system.integrator, system.substeps));
  for (const PublishedTopic& topic : system.published.topics) {
    out += fmt::format("    ROS           {} ({})\n", topic.topic, topic.type);
  }
  out += fmt::format("    LCM           {}\n", fmt::join(system.published.channels, ", "));
  if (!system.ensemble.empty()) {
    out += fmt::format("    ensemble      {}\n", system.ensemble);
  }
  return out + fmt::format("    a step costs  {}, memory {:.1f} kB, no extra thread\n",
                           costText(system.step_cost, system.preparation),
                           static_cast<double>(system.memory) / 1000.0);
}

}  // namespace

std::string text(const SceneCheck& check) {
  const Scene& scene = check.scene;
  std::string out = fmt::format(
      "{}: scene '{}' is valid\n  step {:g} s ({:g} Hz), from t = {:g} s, gravity {:g} m/s^2\n",
      scene.source, printable(scene.name), scene.stepSeconds(), 1.0 / scene.stepSeconds(),
      static_cast<double>(scene.time) / 1.0e9, scene.gravity);
  if (!scene.drives.empty()) {
    out += "drives\n";
  }
  for (const DriveSpec& drive : scene.drives) {
    out += driveText(drive, check.drives.at(drive.name));
  }
  out += "systems\n";
  for (const SystemCheck& system : check.systems) {
    out += checkedSystemText(system);
  }
  if (!scene.controllers.empty()) {
    out += "controllers\n";
  }
  for (const ControllerSpec& controller : scene.controllers) {
    out += checkedControllerText(scene, controller, check.controllers.at(controller.name));
  }
  double preparation = 0.0;
  for (const SystemCheck& system : check.systems) {
    preparation += system.preparation;
  }
  out += fmt::format("all systems\n  a step costs {}", costText(check.step_cost, preparation));
  if (!std::isnan(check.step_cost)) {
    const double factor = static_cast<double>(scene.step) / check.step_cost;
    out +=
        fmt::format(": {} times faster than real time",
                    factor < 100.0 ? fmt::format("{:.3g}", factor) : fmt::format("{:.0f}", factor));
  }
  return out + fmt::format(
                   "\n  memory {:.1f} kB, and {} bytes for each step in flight\n  live, three "
                   "threads beside those of ROS: one steps everything, one publishes, one answers "
                   "services\n",
                   static_cast<double>(check.memory) / 1000.0, check.record);
}

}  // namespace whirl_twin
