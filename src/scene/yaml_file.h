// Reads a YAML file as a tree, without interpreting its keys.
#pragma once

#include <yaml-cpp/yaml.h>

#include <string>

namespace whirl_twin {

/// The tree of a file that should be `what`, as "a scene" that has `contents`. Throws InputError,
/// "PATH: why", for a path that does not exist or is not a regular file, a file larger than 4 MiB,
/// binary, not YAML or empty, or one beyond its bounds: 64 levels, a million entries, a hundred
/// thousand by aliases. A stream is read to its end; "-" is standard input.
YAML::Node readYamlFile(const std::string& path, const std::string& what,
                        const std::string& contents);

/// The same for a text; `source` is its name in messages.
YAML::Node readYamlText(const std::string& text, const std::string& source, const std::string& what,
                        const std::string& contents);

/// "-", "/dev/stdin" or "/dev/fd/N": what is read once, in place of a file.
bool isYamlStream(const std::string& path);
/// Name of "-" in messages.
inline constexpr const char* kStandardInput = "standard input";

/// A deep copy, also of nodes shared within the tree (anchors).
YAML::Node separated(const YAML::Node& tree);

}  // namespace whirl_twin
