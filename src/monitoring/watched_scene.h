// Whether the twin that is watched runs the scene that the monitor judges by: a twin sends its
// scene as text, and it is compared as sceneLines() has it. A scene that was told by a second twin
// beside the one watched is of no account.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "messages/scene_text.h"
#include "twin/scene_lines.h"

namespace whirl_twin {

class WatchedScene {
 public:
  /// The scene of the monitor, and where it is from.
  WatchedScene(SceneLines own, std::string source)
      : own_(std::move(own)), source_(std::move(source)) {}

  /// A twin says which scene it runs; started: that of the run that is watched, as far as it is
  /// known.
  void take(const state::SceneText& told, std::optional<std::int64_t> started);
  /// Another run is watched: what was told last is its scene.
  void follow(std::optional<std::int64_t> started);
  bool told() const { return newest_.has_value(); }
  /// Where the scenes differ, a sentence; "": they do not, or none was told.
  const std::string& mismatch() const { return mismatch_; }

 private:
  std::string differenceOf(const state::SceneText& told) const;

  SceneLines own_;
  std::string source_;
  std::optional<std::int64_t> run_;  ///< that was last followed
  std::optional<state::SceneText> newest_;
  bool agreed_ = false;  ///< in this run
  std::string mismatch_;
};

}  // namespace whirl_twin
