// Studies for tests: a Jeffcott rotor of p = 100 rad/s, zeta = 0.05, and temporary files.
#pragma once

#include <stdlib.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

namespace whirl_twin {

class StudyFiles {
 public:
  StudyFiles() {
    std::string name = (std::filesystem::temp_directory_path() / "whirl_twin_XXXXXX").string();
    folder_ = ::mkdtemp(name.data());
    write("scene.yaml", R"(
name: study
step: 0.001
drives:
  shaft:
    speed: 0.0
    profile:
      - {speed: 150.0, max_acceleration: 100.0}
      - {speed: 200.0, max_acceleration: 50.0, max_jerk: 500.0}
systems:
  rotor:
    model: jeffcott_rotor
    drive: shaft
    parameters: {mass: 1.0, stiffness: 1.0e4, damping: 10.0, eccentricity: 1.0e-4}
)");
  }
  ~StudyFiles() {
    std::error_code ignored;
    std::filesystem::remove_all(folder_, ignored);
  }
  StudyFiles(const StudyFiles&) = delete;
  StudyFiles& operator=(const StudyFiles&) = delete;

  std::string write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name, std::ios::binary) << text;
    return (folder_ / name).string();
  }
  /// A study of the scene with all that is not `study`.
  std::string study(const std::string& rest) const {
    return write("study.yaml", "study: {scene: scene.yaml, seed: 7}\n" + rest);
  }
  std::string contents(const std::string& name) const {
    std::ifstream file(folder_ / name, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  }
  std::string path(const std::string& name) const { return (folder_ / name).string(); }

 private:
  std::filesystem::path folder_;
};

}  // namespace whirl_twin
