// The scenes of the package.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace whirl_twin {

/// Their folder: of the installation that the program or the Python module belongs to, or in the
/// source that it was built from. Empty if neither exists.
std::filesystem::path shippedSceneFolder();

/// The scene files of a folder, sorted by name.
std::vector<std::filesystem::path> sceneFiles(const std::filesystem::path& folder);

/// The file for the argument SCENE on the command line: a path, or the name of a shipped scene as
/// in roslaunch.
std::string scenePath(const std::string& scene);

}  // namespace whirl_twin
