#include "monitoring/watched_scene.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <utility>

#include "messages/input_error.h"
#include "messages/names.h"
#include "scene/yaml_file.h"

namespace whirl_twin {
namespace {

std::string shown(const SceneLines& scene, const std::string& path) {
  const auto line = scene.find(path);
  return line == scene.end() ? "nothing" : printable(line->second);
}

}  // namespace

void WatchedScene::take(const state::SceneText& reported, std::optional<std::int64_t> started) {
  follow(started);
  newest_ = reported;
  const std::string difference = differenceOf(reported);
  if (difference.empty()) {
    agreed_ = true;
    mismatch_.clear();
  } else if (!agreed_) {
    mismatch_ = difference;
  }
}

void WatchedScene::follow(std::optional<std::int64_t> started) {
  if (!started || started == run_) {
    return;
  }
  const bool another = run_.has_value();
  run_ = started;
  if (another && newest_) {
    mismatch_ = differenceOf(*newest_);
    agreed_ = mismatch_.empty();
  }
}

std::string WatchedScene::differenceOf(const state::SceneText& reported) const {
  SceneLines its;
  try {
    its = sceneLines(readYamlText(fmt::format("{}", fmt::join(reported.line, "\n")),
                                  reported.source, "a scene", "systems"));
  } catch (const InputError& why) {
    return fmt::format("the scene of the twin cannot be read: {}", printable(why.what(), 300));
  }
  SceneLines all = its;
  all.insert(own_.begin(), own_.end());
  for (const auto& [path, line] : all) {
    const auto mine = own_.find(path);
    const auto theirs = its.find(path);
    if (mine == own_.end() || theirs == its.end() || mine->second != theirs->second) {
      return fmt::format(
          "the scene of the twin ({}) differs from that of the monitor ({}): {} is {} there, {} "
          "here; no evaluation until the monitor is started with the scene of the twin",
          printable(reported.source), printable(source_), printable(path), shown(its, path),
          shown(own_, path));
    }
  }
  return "";
}

}  // namespace whirl_twin
