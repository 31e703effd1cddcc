#include "scene/yaml_file.h"

#include <fmt/format.h>
#include <yaml-cpp/eventhandler.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <sstream>
#include <utility>
#include <vector>

#include "messages/input_error.h"
#include "messages/names.h"

namespace whirl_twin {

namespace {

constexpr std::uintmax_t kMaxYamlSize = 4u << 20;  // bytes; a scene of ten thousand systems is less
constexpr std::size_t kMaxDepth = 64;
constexpr std::size_t kMaxNodes = 1'000'000;  // without aliases
constexpr std::size_t kMaxAliased = 100'000;  // in addition, copied by aliases

/// Counts the nodes of a text before the tree is built.
class YamlBounds : public YAML::EventHandler {
 public:
  void OnDocumentStart(const YAML::Mark&) override {}
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark& mark, YAML::anchor_t anchor) override { leaf(mark, anchor); }
  void OnScalar(const YAML::Mark& mark, const std::string&, YAML::anchor_t anchor,
                const std::string&) override {
    leaf(mark, anchor);
  }
  void OnAlias(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    const auto found = sizes_.find(anchor);
    if (found == sizes_.end()) {
      throw YAML::ParserException(mark, "an alias refers to a node that contains it");
    }
    aliased_ += found->second;
    if (aliased_ > kMaxAliased) {
      throw YAML::ParserException(
          mark, fmt::format("aliases expand to more than {} entries", kMaxAliased));
    }
    count_ += found->second;
  }
  void OnSequenceStart(const YAML::Mark& mark, const std::string&, YAML::anchor_t anchor,
                       YAML::EmitterStyle::value) override {
    open(mark, anchor);
  }
  void OnSequenceEnd() override { close(); }
  void OnMapStart(const YAML::Mark& mark, const std::string&, YAML::anchor_t anchor,
                  YAML::EmitterStyle::value) override {
    open(mark, anchor);
  }
  void OnMapEnd() override { close(); }

 private:
  void leaf(const YAML::Mark& mark, YAML::anchor_t anchor) {
    if (++count_ > kMaxNodes + kMaxAliased) {
      throw YAML::ParserException(mark, fmt::format("more than {} entries", kMaxNodes));
    }
    sizes_[anchor] = 1;
  }
  void open(const YAML::Mark& mark, YAML::anchor_t anchor) {
    if (open_.size() == kMaxDepth) {
      throw YAML::ParserException(mark, fmt::format("nested more than {} deep", kMaxDepth));
    }
    open_.emplace_back(anchor, count_);
    leaf(mark, 0);
  }
  void close() {
    const auto [anchor, before] = open_.back();
    open_.pop_back();
    sizes_[anchor] = count_ - before;
  }

  std::map<YAML::anchor_t, std::size_t> sizes_;  // of completed nodes; 0: no anchor
  std::vector<std::pair<YAML::anchor_t, std::size_t>> open_;
  std::size_t count_ = 0;  // including aliases
  std::size_t aliased_ = 0;
};

}  // namespace

bool isYamlStream(const std::string& path) {
  return path == "-" || path == "/dev/stdin" || path.rfind("/dev/fd/", 0) == 0;
}

YAML::Node readYamlFile(const std::string& path, const std::string& what,
                        const std::string& contents) {
  const std::string source = path == "-" ? kStandardInput : path;
  const auto inputError = [&](const std::string& why) {
    return InputError(fmt::format("{}: {}", source, why));
  };
  std::error_code error;
  const bool stream = isYamlStream(path);
  if (!stream && !std::filesystem::exists(path, error)) {
    throw inputError("no such file");
  }
  // Reading a device might not end, and a pipe would block until it is written.
  if (!stream && !std::filesystem::is_regular_file(path, error)) {
    throw inputError("not a file");
  }
  if (!stream && std::filesystem::file_size(path, error) > kMaxYamlSize) {
    throw inputError(fmt::format("larger than 4 MiB, the limit of {}", what));
  }
  std::ifstream file(path == "-" ? "/dev/stdin" : path, std::ios::binary);
  std::string text(stream ? kMaxYamlSize + 1 : 0, '\0');
  if (stream) {
    file.read(text.data(), static_cast<std::streamsize>(text.size()));
    text.resize(static_cast<std::size_t>(file.gcount()));
    if (text.size() > kMaxYamlSize) {
      throw inputError(fmt::format("larger than 4 MiB, the limit of {}", what));
    }
  } else {
    text.assign(std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>());
  }
  if (!file.is_open() || (!file.good() && !file.eof())) {
    throw inputError("cannot be read");
  }
  return readYamlText(text, source, what, contents);
}

YAML::Node readYamlText(const std::string& text, const std::string& source, const std::string& what,
                        const std::string& contents) {
  const auto inputError = [&](const std::string& why) {
    return InputError(fmt::format("{}: {}", source, why));
  };
  if (text.find('\0') != std::string::npos) {
    throw inputError(fmt::format("a binary file, not {} in YAML", what));
  }
  YAML::Node tree;
  try {
    std::istringstream events(text);
    YamlBounds bounds;
    YAML::Parser(events).HandleNextDocument(bounds);
    tree = YAML::Load(text);
  } catch (const YAML::Exception& e) {
    const std::string why = printable(e.msg);
    throw inputError(e.mark.is_null() ? fmt::format("not YAML: {}", why)
                                      : fmt::format("line {}, column {}: not YAML: {}",
                                                    e.mark.line + 1, e.mark.column + 1, why));
  }
  if (!tree.IsDefined() || tree.IsNull()) {
    throw inputError(fmt::format("empty: {} has {}", what, contents));
  }
  return tree;
}

YAML::Node separated(const YAML::Node& tree) {
  if (tree.IsMap()) {
    YAML::Node copy(YAML::NodeType::Map);
    for (const auto& entry : tree) {
      copy.force_insert(separated(entry.first), separated(entry.second));
    }
    return copy;
  }
  if (tree.IsSequence()) {
    YAML::Node copy(YAML::NodeType::Sequence);
    for (const auto& entry : tree) {
      copy.push_back(separated(entry));
    }
    return copy;
  }
  return tree.IsScalar() ? YAML::Node(tree.Scalar()) : YAML::Node(YAML::NodeType::Null);
}

}  // namespace whirl_twin
