#include "reports/loop_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "algebra/constants.h"
#include "messages/input_error.h"
#include "reports/report_values.h"
#include "scene/closed_loop.h"

namespace whirl_twin {

namespace {

constexpr double kNothing = 1e-12;  // of a place or an output, in its unit

/// What a controller measures in steady motions.
std::vector<double> measuredIn(const ControllerSpec& controller, const HeldMotions& motions) {
  std::vector<double> values;
  for (const SignalSpec& signal : controller.measures) {
    const ClosedLoopEquilibrium& motion = motions.at(signal.system);
    const SignalRow row = rowOf(signal, *motion.dynamics);
    values.push_back(row.along.dot(row.of_rates ? motion.v : motion.q));
  }
  return values;
}

/// The controllers of a loop, in its order.
std::vector<LoopedController> loopedControllers(const Scene& scene, const ClosedLoop& loop,
                                                std::optional<double> speed) {
  LoopedController all;
  for (const std::size_t i : loop.controllers()) {
    all.loop.push_back(scene.controllers[i].name);
  }
  all.shaft_speed = speed.value_or(
      startSpeedOf(scene, scene.controllers[loop.controllers().front()].measures.front().system));
  try {
    const auto parts = loop.parts(
        [&](std::size_t system) { return motionAtStart(scene, system, speed); }, all.shaft_speed);
    if (!parts) {
      throw RunFailure("a control law of the loop is not linear");
    }
    const SampledLoop sampled = sampledLoop(parts->plant, parts->controllers);
    all.stability = sampledStability(sampled);
    all.period = sampled.period;
    const Verdict verdict = all.stability->verdict;
    all.at_once = sampledMarginsAtOnce(parts->plant, parts->controllers, verdict);
    std::vector<LoopedController> controllers(parts->controllers.size(), all);
    for (std::size_t i = 0; i < controllers.size(); ++i) {
      if (!parts->outputs.empty()) {
        controllers[i].held_measured = measuredIn(loop.controller(i), parts->about);
        controllers[i].held_outputs = {parts->outputs[i].begin(), parts->outputs[i].end()};
      }
      controllers[i].law = parts->controllers[i].law;
      controllers[i].gains = loop.law(i).law().gains();
      controllers[i].margins = sampledMargins(parts->plant, parts->controllers, i, verdict);
      controllers[i].at_outputs =
          sampledMargins(parts->plant, parts->controllers, i, verdict, LoopSide::kOutputs);
      controllers[i].responses = sampledResponses(parts->plant, parts->controllers, i);
    }
    return controllers;
  } catch (const RunFailure& failure) {
    all.objection = failure.what();
    return {loop.controllers().size(), all};
  }
}

Json robustnessJson(const LoopMargins& margins) {
  return {{"gain_margin", margins.gain_margin},
          {"gain_reduction", margins.gain_reduction},
          {"phase_margin", margins.phase_margin},
          {"phase_crossover", margins.phase_crossover},
          {"delay_margin", margins.delay_margin}};
}

Json marginsJson(const LoopMargins& margins) {
  Json json{{"sensitivity_peak", margins.sensitivity_peak},
            {"peak_frequency", margins.peak_frequency},
            {"zone", name(margins.zone)}};
  json.update(robustnessJson(margins));
  return json;
}

Json placesJson(const std::vector<std::string>& names, const std::vector<SampledMargins>& margins) {
  Json places = Json::array();
  for (std::size_t i = 0; i < margins.size(); ++i) {
    Json place{{"signal", names[i]}};
    place.update(marginsJson(margins[i]));
    place["bode_error"] = margins[i].bode_error;
    places.push_back(place);
  }
  return places;
}

Json byName(const std::vector<std::string>& names, const std::vector<double>& values) {
  Json json = Json::object();
  for (std::size_t i = 0; i < names.size(); ++i) {
    json[names[i]] = values[i];
  }
  return json;
}

/// "arm.theta 1.5, arm.torque 9.785"; what is 0 to the last digits is 0.
std::string heldText(const LoopedController& controller) {
  std::vector<std::string> parts;
  const auto put = [&](const std::vector<std::string>& names, const std::vector<double>& values) {
    for (std::size_t i = 0; i < names.size(); ++i) {
      parts.push_back(
          fmt::format("{} {:.4g}", names[i], std::fabs(values[i]) < kNothing ? 0.0 : values[i]));
    }
  };
  put(controller.spec->measured, controller.held_measured);
  put(controller.spec->acted_on, controller.held_outputs);
  return fmt::format("{}", fmt::join(parts, ", "));
}

bool holdsSomething(const LoopedController& controller) {
  const auto something = [](double value) { return std::fabs(value) >= kNothing; };
  return std::any_of(controller.held_measured.begin(), controller.held_measured.end(), something) ||
         std::any_of(controller.held_outputs.begin(), controller.held_outputs.end(), something);
}

Json loopedControllerJson(const LoopedController& controller) {
  Json json{{"type", controller.spec->type},
            {"rate", controller.spec->rate},
            {"delay", static_cast<double>(controller.spec->delay) / 1e9},
            {"loop", controller.loop},
            {"shaft_speed", controller.shaft_speed}};
  if (!controller.stability) {
    json["verdict"] = name(Verdict::kUncertain);
    json["objection"] = controller.objection;
    return json;
  }
  const SampledStability& stability = *controller.stability;
  json.update({{"verdict", name(stability.verdict)},
               {"exact", stability.exact},
               {"spectral_radius", stability.spectral_radius},
               {"period", controller.period}});
  if (!controller.held_measured.empty()) {
    json["held"] = {{"measured", byName(controller.spec->measured, controller.held_measured)},
                    {"outputs", byName(controller.spec->acted_on, controller.held_outputs)}};
  }
  json["inside"] = stability.routh.left;
  json["on_circle"] = stability.routh.imaginary;
  json["outside"] = stability.routh.right;
  if (!controller.margins.empty()) {
    json.update(marginsJson(leastMargins(controller.at_once, controller.margins)));
    json["all_at_once"] = robustnessJson(controller.at_once);
    json["axes"] = placesJson(controller.spec->measured, controller.margins);
    json["plant_inputs"] = placesJson(controller.spec->acted_on, controller.at_outputs);
  }
  json["eigenvalues"] = listJson(stability.eigenvalues, complexJson);
  if (controller.law) {
    const DiscreteStateSpace& law = *controller.law;
    json["law"] = {{"a", matrixJson(law.a)},
                   {"b", matrixJson(law.b)},
                   {"c", matrixJson(law.c)},
                   {"d", matrixJson(law.d)}};
    if (law.a.size() == 0) {
      json["gains"]["feedback"] = matrixJson(-law.d);
    }
  }
  for (const Controller::Gain& gain : controller.gains) {
    json["gains"][gain.name] = matrixJson(gain.matrix);
  }
  return json;
}

/// A margin; there is no end to some.
std::string orAny(double margin, const char* format) {
  return std::isfinite(margin) ? fmt::format(fmt::runtime(format), margin)
         : std::isnan(margin)  ? "not known"
                               : "any";
}

/// "gain times 0.5 to 2, phase 40 degrees, delay 0.01 s more"
std::string robustnessText(const LoopMargins& margins) {
  return fmt::format("gain times {} to {}, phase {}, delay {}",
                     orAny(margins.gain_reduction, "{:.4g}"), orAny(margins.gain_margin, "{:.4g}"),
                     orAny(margins.phase_margin / kDegree, "{:.3g} degrees"),
                     orAny(margins.delay_margin, "additional {:.3g} s"));
}

std::string placesText(const char* title, const std::vector<std::string>& names,
                       const std::vector<SampledMargins>& margins) {
  std::string out = fmt::format("  {}, each alone, all other loops closed\n", title);
  for (std::size_t i = 0; i < margins.size(); ++i) {
    const SampledMargins& place = margins[i];
    out += fmt::format("    at {:<12} ", names[i]);
    out += place.zone == SensitivityZone::kUnbounded
               ? std::string("sensitivity unbounded\n")
               : fmt::format("sensitivity {:.4g} at {:.4g} rad/s, zone {}; {}\n",
                             place.sensitivity_peak, place.peak_frequency, name(place.zone),
                             robustnessText(place));
  }
  return out;
}

/// What a design has computed, for comparison and for a controller outside.
std::string gainsText(const LoopedController& controller) {
  std::string out;
  if (controller.law && controller.law->a.size() == 0) {
    out += matrixText("K of u = -K (y - setpoint)", -controller.law->d);
  }
  for (const Controller::Gain& gain : controller.gains) {
    out += matrixText(gain.name, gain.matrix);
  }
  return out;
}

std::string loopedControllerText(const LoopedController& controller) {
  const ControllerSpec& spec = *controller.spec;
  std::string out = fmt::format(
      "{}: {} at {:g} Hz, {}\n  measures {}, acts on {}\n", spec.name, spec.type, spec.rate,
      spec.delay == 0 ? "without delay"
                      : fmt::format("delay {:g} s", static_cast<double>(spec.delay) / 1e9),
      fmt::join(spec.measured, ", "), fmt::join(spec.acted_on, ", "));
  if (controller.loop.size() > 1) {
    out += fmt::format("  one loop with    {}\n", fmt::join(controller.loop, ", "));
  }
  if (!controller.stability) {
    return out + fmt::format("  cannot be evaluated: {}\n", controller.objection);
  }
  const SampledStability& stability = *controller.stability;
  out += fmt::format("  closed loop      {}{}\n", verdictText(stability.verdict),
                     stability.exact ? " (Routh, exact)" : " (by eigenvalues)");
  if (holdsSomething(controller)) {
    out += fmt::format("  equilibrium      {}\n", heldText(controller));
  }
  out += fmt::format(
      "  spectral radius  {:.9g} in {:g} s{}\n", stability.spectral_radius, controller.period,
      controller.loop.size() > 1 ? ", the period after which all samples repeat" : ", one sample");
  out += gainsText(controller);
  out += fmt::format("  all at once      {}\n",
                     std::isinf(controller.at_once.sensitivity_peak)
                         ? "no margins"
                         : robustnessText(controller.at_once) + ": every sensor, or every output");
  out += placesText("sensors", spec.measured, controller.margins);
  out += placesText("outputs (inputs of the plant)", spec.acted_on, controller.at_outputs);
  return out;
}

}  // namespace

LoopReport loopReport(const Scene& scene, std::optional<double> speed) {
  LoopReport report;
  report.scene = &scene;
  report.controllers.resize(scene.controllers.size());
  for (const ClosedLoop& loop : closedLoops(scene)) {
    std::vector<LoopedController> controllers = loopedControllers(scene, loop, speed);
    for (std::size_t k = 0; k < controllers.size(); ++k) {
      const std::size_t i = loop.controllers()[k];
      report.controllers[i] = std::move(controllers[k]);
      report.controllers[i].spec = &scene.controllers[i];
    }
  }
  return report;
}

Json json(const LoopReport& report) {
  Json json{{"scene", report.scene->name}, {"controllers", Json::object()}};
  for (const LoopedController& controller : report.controllers) {
    json["controllers"][controller.spec->name] = loopedControllerJson(controller);
  }
  return json;
}

std::string text(const LoopReport& report) {
  return joined(report.controllers, loopedControllerText, "\n");
}

}  // namespace whirl_twin
