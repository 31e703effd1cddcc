// Reads a YAML file as a tree, without interpreting its keys.
#pragma once

#include <yaml-cpp/yaml.h>

#include <string>

namespace whirl_twin {

/// The tree of a file that should be `what`, as "a scene" that has `contents`. Throws InputError,
/// "PATH: why", for a path that does not exist or is not a regular file, a file larger than 4 MiB,
/// binary, not YAML or empty, or one beyond its bounds: 64 levels, a million entries, a hundred
/// thousand by aliases.
YAML::Node readYamlFile(const std::string& path, const std::string& what,
                        const std::string& contents);

/// The same for a text; `source` is its name in messages.
YAML::Node readYamlText(const std::string& text, const std::string& source, const std::string& what,
                        const std::string& contents);

}  // namespace whirl_twin
