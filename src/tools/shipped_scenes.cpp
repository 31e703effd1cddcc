#include "tools/shipped_scenes.h"

#include <algorithm>

namespace whirl_twin {

namespace fs = std::filesystem;

fs::path shippedSceneFolder() {
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  for (const fs::path& folder : {program.parent_path() / "../share/whirl_twin/config/scenes",
                                 fs::path(WHIRL_TWIN_SOURCE_SCENES)}) {
    if (fs::is_directory(folder, error)) {
      return fs::weakly_canonical(folder, error);
    }
  }
  return {};
}

std::vector<fs::path> sceneFiles(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, error)) {
    if (entry.path().extension() == ".yaml" && entry.is_regular_file(error)) {
      files.push_back(entry.path());
    }
  }
  std::sort(files.begin(), files.end());
  return files;
}

std::string scenePath(const std::string& scene) {
  std::error_code error;
  const bool name = scene.find('/') == std::string::npos && fs::path(scene).extension() != ".yaml";
  if (!name || fs::exists(scene, error)) {
    return scene;
  }
  const fs::path shipped = shippedSceneFolder() / (scene + ".yaml");
  return fs::exists(shipped, error) ? shipped.string() : scene;
}

}  // namespace whirl_twin
