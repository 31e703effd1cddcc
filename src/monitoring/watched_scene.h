// Whether the monitored twin runs the scene of the monitor: a twin publishes its scene as text, and
// it is compared by sceneLines(). A scene from a duplicate publisher is ignored.
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

  /// A twin reports its scene; started: that of the monitored run, as far as it is known.
  void take(const state::SceneText& reported, std::optional<std::int64_t> started);
  /// A different run is monitored: the scene reported last is its scene.
  void follow(std::optional<std::int64_t> started);
  bool received() const { return newest_.has_value(); }
  /// Where the scenes differ, a sentence; "": they do not, or none was reported.
  const std::string& mismatch() const { return mismatch_; }

 private:
  std::string differenceOf(const state::SceneText& reported) const;

  SceneLines own_;
  std::string source_;
  std::optional<std::int64_t> run_;  ///< that was last followed
  std::optional<state::SceneText> newest_;
  bool agreed_ = false;  ///< in this run
  std::string mismatch_;
};

}  // namespace whirl_twin
