#include "reports/loop_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "messages/refusal.h"
#include "reports/verdict_text.h"
#include "scene/closed_loop.h"

namespace whirl_twin {

namespace {

constexpr double kDegrees = 57.295779513082320877;  // in a radian

/// The controllers of a loop, in its order.
std::vector<LoopedController> judged(const Scene& scene, const ClosedLoop& loop,
                                     std::optional<double> speed) {
  LoopedController all;
  for (const std::size_t i : loop.controllers()) {
    all.loop.push_back(scene.controllers[i].name);
  }
  all.shaft_speed = speed.value_or(
      startSpeedOf(scene, scene.controllers[loop.controllers().front()].measures.front().system));
  const auto parts =
      loop.parts([&](std::size_t system) { return smallMotionAtStart(scene, system, speed); },
                 all.shaft_speed);
  if (!parts) {
    all.objection = "a law of the loop is not linear";
    return {loop.controllers().size(), all};
  }
  try {
    const SampledLoop sampled = sampledLoop(parts->plant, parts->controllers);
    all.stability = sampledStability(sampled);
    all.period = sampled.period;
    std::vector<LoopedController> controllers(parts->controllers.size(), all);
    for (std::size_t i = 0; i < controllers.size(); ++i) {
      controllers[i].margins =
          sampledMargins(parts->plant, parts->controllers, i, all.stability->verdict);
      controllers[i].responses = sampledResponses(parts->plant, parts->controllers, i);
    }
    return controllers;
  } catch (const RunFailure& failure) {
    all.objection = failure.what();
    return {loop.controllers().size(), all};
  }
}

Json marginsJson(const LoopMargins& margins) {
  return {{"sensitivity_peak", margins.sensitivity_peak},
          {"peak_frequency", margins.peak_frequency},
          {"zone", name(margins.zone)},
          {"gain_margin", margins.gain_margin},
          {"gain_reduction", margins.gain_reduction},
          {"phase_margin", margins.phase_margin},
          {"phase_crossover", margins.phase_crossover},
          {"delay_margin", margins.delay_margin}};
}

Json controllerJson(const LoopedController& controller) {
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
  json["verdict"] = name(stability.verdict);
  json["exact"] = stability.exact;
  json["spectral_radius"] = stability.spectral_radius;
  json["period"] = controller.period;
  json["inside"] = stability.routh.left;
  json["on_circle"] = stability.routh.imaginary;
  json["outside"] = stability.routh.right;
  if (!controller.margins.empty()) {
    json.update(marginsJson(leastMargins(controller.margins)));
    for (std::size_t i = 0; i < controller.margins.size(); ++i) {
      Json axis{{"signal", controller.spec->measured[i]}};
      axis.update(marginsJson(controller.margins[i]));
      axis["bode_error"] = controller.margins[i].bode_error;
      json["axes"].push_back(axis);
    }
  }
  json["eigenvalues"] = Json::array();
  for (const std::complex<double>& z : stability.eigenvalues) {
    json["eigenvalues"].push_back({z.real(), z.imag()});
  }
  return json;
}

std::string controllerText(const LoopedController& controller) {
  const ControllerSpec& spec = *controller.spec;
  std::string out = fmt::format(
      "{}: {} at {:g} Hz, {}\n  measures {}, acts on {}\n", spec.name, spec.type, spec.rate,
      spec.delay == 0 ? "without delay"
                      : fmt::format("{:g} s late", static_cast<double>(spec.delay) / 1e9),
      fmt::join(spec.measured, ", "), fmt::join(spec.acted_on, ", "));
  if (controller.loop.size() > 1) {
    out += fmt::format("  one loop with    {}\n", fmt::join(controller.loop, ", "));
  }
  if (!controller.stability) {
    return out + fmt::format("  cannot be judged: {}\n", controller.objection);
  }
  const SampledStability& stability = *controller.stability;
  out += fmt::format("  closed loop      {}{}\n", verdictText(stability.verdict),
                     stability.exact ? " (Routh, exact)" : " (by eigenvalues)");
  out += fmt::format("  spectral radius  {:.9g} in {:g} s{}\n", stability.spectral_radius,
                     controller.period,
                     controller.loop.size() > 1 ? ", after which all samples come again"
                                                : ", from sample to sample");
  for (std::size_t i = 0; i < controller.margins.size(); ++i) {
    const SampledMargins& axis = controller.margins[i];
    out += fmt::format("  at {:<14} ", spec.measured[i]);
    out +=
        axis.zone == SensitivityZone::kUnbounded
            ? std::string("sensitivity without bound\n")
            : fmt::format(
                  "sensitivity {:.4g} at {:.4g} rad/s, zone {}; gain times {:.4g} to "
                  "{:.4g}, phase {:.3g} degrees, delay {:.3g} s more\n",
                  axis.sensitivity_peak, axis.peak_frequency, name(axis.zone), axis.gain_reduction,
                  axis.gain_margin, axis.phase_margin * kDegrees, axis.delay_margin);
  }
  return out;
}

}  // namespace

LoopReport loopReport(const Scene& scene, std::optional<double> speed) {
  LoopReport report;
  report.scene = &scene;
  report.controllers.resize(scene.controllers.size());
  for (const ClosedLoop& loop : closedLoops(scene)) {
    std::vector<LoopedController> controllers = judged(scene, loop, speed);
    for (std::size_t k = 0; k < controllers.size(); ++k) {
      const std::size_t i = loop.controllers()[k];
      report.controllers[i] = std::move(controllers[k]);
      report.controllers[i].spec = &scene.controllers[i];
    }
  }
  return report;
}

Json json(const LoopReport& report) {
  Json json;
  json["scene"] = report.scene->name;
  json["controllers"] = Json::object();
  for (const LoopedController& controller : report.controllers) {
    json["controllers"][controller.spec->name] = controllerJson(controller);
  }
  return json;
}

std::string text(const LoopReport& report) {
  std::string out;
  for (const LoopedController& controller : report.controllers) {
    out += (out.empty() ? "" : "\n") + controllerText(controller);
  }
  return out;
}

}  // namespace whirl_twin
