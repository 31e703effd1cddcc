#include "scene/yaml_file.h"

#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include "messages/names.h"
#include "messages/refusal.h"

namespace whirl_twin {

namespace {

constexpr std::uintmax_t kMaxYamlSize = 4u << 20;  // bytes; a scene of ten thousand systems is less

}  // namespace

YAML::Node readYamlFile(const std::string& path, const std::string& what,
                        const std::string& contents) {
  const auto refusal = [&](const std::string& why) {
    return Refusal(fmt::format("{}: {}", path, why));
  };
  std::error_code error;
  if (!std::filesystem::exists(path, error)) {
    throw refusal("no such file");
  }
  // A device has no end, and a pipe waits for somebody to write.
  if (!std::filesystem::is_regular_file(path, error)) {
    throw refusal("not a file");
  }
  if (std::filesystem::file_size(path, error) > kMaxYamlSize) {
    throw refusal(fmt::format("larger than 4 MiB: not {}", what));
  }
  std::ifstream file(path, std::ios::binary);
  const std::string text((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
  if (!file.good() && !file.eof()) {
    throw refusal("cannot be read");
  }
  return readYamlText(text, path, what, contents);
}

YAML::Node readYamlText(const std::string& text, const std::string& source, const std::string& what,
                        const std::string& contents) {
  const auto refusal = [&](const std::string& why) {
    return Refusal(fmt::format("{}: {}", source, why));
  };
  if (text.find('\0') != std::string::npos) {
    throw refusal(fmt::format("a binary file, not {} in YAML", what));
  }
  YAML::Node tree;
  try {
    tree = YAML::Load(text);
  } catch (const YAML::Exception& e) {
    const std::string why = printable(e.msg);
    throw refusal(e.mark.is_null() ? fmt::format("not YAML: {}", why)
                                   : fmt::format("line {}, column {}: not YAML: {}",
                                                 e.mark.line + 1, e.mark.column + 1, why));
  }
  if (!tree.IsDefined() || tree.IsNull()) {
    throw refusal(fmt::format("empty: {} has {}", what, contents));
  }
  return tree;
}

}  // namespace whirl_twin
