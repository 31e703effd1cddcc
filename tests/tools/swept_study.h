// Studies of one rotor, in a temporary folder.
#pragma once

#include <string>
#include <vector>

#include "twin_program.h"

namespace whirl_twin {

/// A Jeffcott rotor below its critical speed of 100 rad/s.
inline const std::string kStudiedRotor = R"(
step: 0.001
systems:
  rotor:
    model: jeffcott_rotor
    drive: shaft
    parameters: {mass: 1.0, stiffness: 1.0e4, damping: 10.0, eccentricity: 1.0e-4}
drives: {shaft: {speed: 90.0}}
)";

/// A study of 300 points in 30 blocks, one in ten of which is rejected.
inline const std::string kStudyOfBlocks = R"(
study: {scene: scene.yaml, seed: 3, block: 10}
vary:
  rotor.stiffness: {uniform: [0.9e4, 1.1e4]}
  rotor.damping: {normal: [10.0, 7.8]}
design: {latin_hypercube: 300}
run: {duration: 0.3}
measure: {peak: max(rotor.whirl.radius), frequency: "natural_frequencies[0]"}
require: {peak: "< 4.0e-4"}
)";

struct StudyFiles : TemporaryDirectory {
  std::string study;

  explicit StudyFiles(const std::string& text = kStudyOfBlocks) {
    write("scene.yaml", kStudiedRotor);
    study = write("study.yaml", text);
  }
  /// Arguments of `twin`.
  std::vector<std::string> command(const std::string& folder,
                                   const std::vector<std::string>& more = {}) const {
    std::vector<std::string> arguments{"sweep", study, "--output", file(folder)};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
  }
  Ending sweep(const std::string& folder, const std::vector<std::string>& more = {}) const {
    return twin(command(folder, more));
  }
  /// All of a folder's tables.
  std::string results(const std::string& folder) const {
    std::string all;
    for (const char* name : {"/results.csv", "/failed.csv", "/results.h5"}) {
      all += contentsOf(file(folder) + name);
    }
    return all;
  }
  /// Names of the files of its blocks, sorted.
  Lines blocks(const std::string& folder) const {
    Lines names;
    for (const auto& entry : std::filesystem::directory_iterator(file(folder) + "/blocks")) {
      names.push_back(entry.path().filename());
    }
    std::sort(names.begin(), names.end());
    return names;
  }
};

}  // namespace whirl_twin
