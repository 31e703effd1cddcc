// One or more examples of each controller, for the tests that apply to all of them.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "made_controller.h"

namespace whirl_twin {

struct ExampleController {
  ParameterValues values;
  Settings settings;
  ControllerPlan plan;
};

inline Settings choice(const std::string& name, const std::string& word) {
  Settings settings;
  settings.choices[name] = word;
  return settings;
}

inline Settings matrices(std::map<std::string, Eigen::MatrixXd> given) {
  Settings settings;
  settings.matrices = std::move(given);
  return settings;
}

/// A row of numbers.
inline Eigen::MatrixXd row(const std::vector<double>& numbers) {
  return Eigen::Map<const Eigen::RowVectorXd>(numbers.data(),
                                              static_cast<Eigen::Index>(numbers.size()));
}

/// Of a motor of constant torque [N m].
inline Settings motorTable(double torque) {
  Settings settings;
  settings.tables["motor"] = {{{{"speed", 0.0}, {"torque", torque}}, {}}};
  return settings;
}

inline ControllerPlan planOf(double rate, std::size_t measured, std::size_t outputs) {
  ControllerPlan plan = planOf(rate, outputs);
  plan.measured = measured;
  return plan;
}

/// Two masses, one unstable and one held by a spring, coupled; a force on each.
inline LinearPlant twoMasses() {
  LinearPlant plant;
  plant.a = Eigen::MatrixXd::Zero(4, 4);
  plant.a.topRightCorner(2, 2).setIdentity();
  plant.a.bottomLeftCorner(2, 2) << 3.0, 0.5, 0.5, -7.0;
  plant.a.bottomRightCorner(2, 2) << -0.1, 0.2, -0.2, -0.1;
  plant.b = Eigen::MatrixXd::Zero(4, 2);
  plant.b.bottomRows(2) << 1.0, 0.0, 0.0, 2.0;
  plant.c = Eigen::MatrixXd::Identity(4, 4);
  return plant;
}

/// The first `measured` states of twoMasses() are measured.
inline ControllerPlan planOfTwoMasses(double rate, std::size_t measured) {
  ControllerPlan plan = planOf(rate, measured, 2);
  plan.plant = twoMasses();
  plan.plant->c.conservativeResize(static_cast<Eigen::Index>(measured), 4);
  return plan;
}

/// Weights of an lqr of twoMasses(), with those of its lqg for `measured` quantities.
inline Settings regulatorOfTwoMasses(const std::string& cost, std::size_t measured = 0) {
  Settings settings = matrices({{"q", row({1, 2, 0.1, 0.2})}, {"r", row({0.3, 0.4})}});
  settings.choices["cost"] = cost;
  if (measured > 0) {
    settings.matrices["process_noise"] = row({0, 0, 1, 2});
    settings.matrices["sensor_noise"] = row(std::vector<double>(measured, 1e-3));
  }
  return settings;
}

inline const std::map<std::string, std::vector<ExampleController>>& exampleControllers() {
  const Eigen::MatrixXd a =
      (Eigen::MatrixXd(3, 3) << 0.5, 0.2, 0, -0.1, 0.9, 0.3, 0, 0.4, -0.2).finished();
  const Eigen::MatrixXd b = (Eigen::MatrixXd(3, 2) << 1, 2, 3, 4, 5, 6).finished();
  static const std::map<std::string, std::vector<ExampleController>> examples{
      {"external", {{{{"timeout", 0.01}}, choice("mode", "free_running"), planOf(100.0, 2)}}},
      {"lead",
       {{{{"gain", 3.0}, {"zero", 20.0}, {"pole", 200.0}}, {}, planOf(1000.0, 2)},
        {{{"gain", 3.0}, {"zero", 20.0}, {"pole", 2.0}, {"prewarp", 6.0}, {"setpoint", 0.1}},
         {},
         planOf(50.0, 1)}}},
      {"linear",
       {{{},
         matrices({{"a", a}, {"b", b}, {"c", row({1, -2, 0.5})}, {"d", row({0.3, -7})}}),
         planOf(100.0, 2, 1)},
        {{}, matrices({{"d", b}, {"setpoint", row({4, -2})}}), planOf(100.0, 2, 3)},
        {{},
         matrices({{"numerator", row({1, -0.3})}, {"denominator", row({2, -1, 0.3, 0.2})}}),
         planOf(100.0, 2)}}},
      {"lqg",
       {{{}, regulatorOfTwoMasses("sampled", 2), planOfTwoMasses(50.0, 2)},
        {{}, regulatorOfTwoMasses("continuous", 1), planOfTwoMasses(500.0, 1)}}},
      {"lqr",
       {{{}, regulatorOfTwoMasses("sampled"), planOfTwoMasses(20.0, 4)},
        {{}, regulatorOfTwoMasses("continuous"), planOfTwoMasses(200.0, 4)}}},
      {"pid",
       {{{{"kp", 2.0}, {"ki", 7.0}, {"kd", 0.3}, {"derivative_time", 0.02}}, {}, planOf(200.0, 1)},
        {{{"kp", -2.0}, {"kd", 0.3}}, {}, planOf(20.0, 3)},
        {{{"kp", 1.5}, {"ki", -0.5}}, choice("anti_windup", "clamping"), planOf(50.0, 2)},
        {{{"kp", 4.0}}, choice("anti_windup", "none"), planOf(1e4, 2)},
        {{{"kp", 4.0}, {"kd", 1.0}, {"notch_rate", 3.0}, {"notch_phase", 0.7}},
         {},
         planOf(100.0, 4)},
        {{{"kp", 4.0}, {"notch_rate", 3.0}}, choice("notch_axes", "single"), planOf(100.0, 3)}}},
      {"speed",
       {{{{"speed", 50.0},
          {"max_acceleration", 20.0},
          {"max_jerk", 90.0},
          {"inertia", 0.1},
          {"drag", 0.2},
          {"kp", 3.0},
          {"ki", 0.7}},
         motorTable(1e9),
         planOf(100.0, 1)},
        {{{"speed", -5.0},
          {"max_acceleration", 2.0},
          {"max_jerk", 9.0},
          {"inertia", 0.1},
          {"kp", 3.0}},
         motorTable(1e9),
         planOf(1000.0, 1)}}},
      {"state_feedback",
       {{{}, matrices({{"gain", row({3, -1, 2, 0.5})}}), planOf(100.0, 4, 1)},
        {{}, matrices({{"gain", b}, {"setpoint", row({1, 2})}}), planOf(100.0, 2, 3)}}},
      {"swing_up",
       {{{{"frequency", 3.0}, {"drive", 0.5}},
         matrices({{"gain", row({7, 8})}}),
         planOf(100.0, 2, 1)}}},
  };
  return examples;
}

}  // namespace whirl_twin
