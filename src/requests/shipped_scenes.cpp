#include "requests/shipped_scenes.h"

#include <dlfcn.h>

#include <algorithm>

namespace whirl_twin {

namespace fs = std::filesystem;

namespace {

constexpr const char* kInstalled = "share/whirl_twin/config/scenes";

/// Folder of the extension module of Python that this is part of; empty in a program.
fs::path moduleFolder() {
  Dl_info info{};
  if (dladdr(reinterpret_cast<const void*>(&moduleFolder), &info) == 0 ||
      info.dli_fname == nullptr || fs::path(info.dli_fname).extension() != ".so") {
    return {};
  }
  std::error_code error;
  return fs::weakly_canonical(info.dli_fname, error).parent_path();
}

}  // namespace

fs::path shippedSceneFolder() {
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error).parent_path();
  std::vector<fs::path> folders{program / ".." / kInstalled, WHIRL_TWIN_SOURCE_SCENES};
  if (const fs::path module = moduleFolder(); !module.empty()) {
    // Of `pip install` beside the module, of other installations below their prefix.
    folders.insert(folders.begin(), {module / "scenes", module / "../../../.." / kInstalled});
  }
  for (const fs::path& folder : folders) {
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
