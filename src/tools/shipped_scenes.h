// The scenes that come with the package.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace whirl_twin {

/// Where they are: beside the installed program, or in the source it was built from. Empty if
/// neither is there.
std::filesystem::path shippedSceneFolder();

/// The scene files of a folder, sorted by name.
std::vector<std::filesystem::path> sceneFiles(const std::filesystem::path& folder);

/// The file that is meant by SCENE on the command line: a path, or the name of a shipped scene as
/// roslaunch takes it.
std::string scenePath(const std::string& scene);

}  // namespace whirl_twin
