// What `twin check` shows of a valid scene.
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "accuracy/error_bound.h"
#include "reports/asked_cost.h"
#include "reports/output.h"
#include "reports/rotor_sheet.h"
#include "twin/twin.h"

namespace whirl_twin {

/// A message on a ROS topic.
struct PublishedTopic {
  std::string topic;
  std::string type;
};

/// Where a system or drive is published.
struct Published {
  std::vector<PublishedTopic> topics;
  std::vector<std::string> channels;  ///< LCM
};

/// Of a shaft of elements.
struct ShaftSize {
  double length = 0.0;      ///< [m]
  double mass = 0.0;        ///< [kg], of its elements and sleeves
  double rotor_mass = 0.0;  ///< [kg], with the discs
};

/// An input that the scene sets.
struct InputCheck {
  InputInfo input;
  InputSignal signal;
};

struct SystemCheck {
  std::string name;
  const ModelInfo* model = nullptr;
  std::vector<CoordinateInfo> coordinates;
  std::string note;                   ///< of the model, how it was set up; may be empty
  std::optional<ShaftSize> shaft;     ///< of a flexible_rotor
  std::vector<std::string> warnings;  ///< why results are uncertain
  std::string integrator;
  std::string reason;  ///< why this one
  int substeps = 1;
  double tolerance = 0.0;  ///< [-], of the scene,
  double horizon = 0.0;    ///< [s], over which
  ErrorBound accuracy;
  std::optional<std::string> drive;
  std::optional<double> speed;    ///< [rad/s], constant
  bool starts_at_rest = false;    ///< at its equilibrium
  std::optional<LargestSag> sag;  ///< of that
  std::vector<InputCheck> inputs;
  Published published;
  double step_cost = 0.0;    ///< [ns]; NaN: it stops at once, or was too expensive to prepare
  double preparation = 0.0;  ///< [s], of its steps, about, where that was too expensive
  std::size_t memory = 0;    ///< [bytes], heap of a twin of it alone
  std::string ensemble;      ///< "1000 members, side by side in vectors", or ""
};

struct SceneCheck {
  Scene scene;
  std::vector<SystemCheck> systems;
  std::map<std::string, Published> drives;  ///< by name
  std::map<std::string, Published> controllers;
  double step_cost = 0.0;  ///< [ns], of all systems together
  std::size_t memory = 0;  ///< [bytes], heap of the running twin
  std::size_t record = 0;  ///< [bytes], of one step's snapshot
};

/// What checkScene() takes.
AskedCost costOfCheck(const Scene& scene, const std::vector<std::size_t>& systems);

/// Checks the systems chosen (indices into scene.systems), all the others aside. Takes a few
/// hundredths of a second to measure what a step costs, besides choosing the steps.
SceneCheck checkScene(const Scene& scene, const std::vector<std::size_t>& systems);

std::string text(const SceneCheck& check);
Json json(const SceneCheck& check);

}  // namespace whirl_twin
