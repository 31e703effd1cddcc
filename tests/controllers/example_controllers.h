// An example or more of each controller, for the tests that hold for all of them.
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

inline const std::map<std::string, std::vector<ExampleController>>& exampleControllers() {
  static const std::map<std::string, std::vector<ExampleController>> examples{
      {"pid",
       {{{{"kp", 2.0}, {"ki", 7.0}, {"kd", 0.3}, {"derivative_time", 0.02}}, {}, planOf(200.0, 1)},
        {{{"kp", -2.0}, {"kd", 0.3}}, {}, planOf(20.0, 3)},
        {{{"kp", 1.5}, {"ki", -0.5}}, choice("anti_windup", "clamping"), planOf(50.0, 2)},
        {{{"kp", 4.0}}, choice("anti_windup", "none"), planOf(1e4, 2)}}},
  };
  return examples;
}

}  // namespace whirl_twin
