// A YAML file as a tree, before any of its keys is looked at.
#pragma once

#include <yaml-cpp/yaml.h>

#include <string>

namespace whirl_twin {

/// The tree in a file that should be `what`, as "a scene" that has `contents`. Throws Refusal,
/// "PATH: why", for what is not there, no regular file, larger than 4 MiB, binary, not YAML,
/// empty, or beyond its bounds: 64 levels, a million entries, a hundred thousand by aliases.
YAML::Node readYamlFile(const std::string& path, const std::string& what,
                        const std::string& contents);

/// The same of a text from elsewhere, which `source` names in messages.
YAML::Node readYamlText(const std::string& text, const std::string& source, const std::string& what,
                        const std::string& contents);

}  // namespace whirl_twin
