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

#include "messages/names.h"
#include "messages/refusal.h"

namespace whirl_twin {

namespace {

constexpr std::uintmax_t kMaxYamlSize = 4u << 20;  // bytes; a scene of ten thousand systems is less
constexpr std::size_t kMaxDepth = 64;
constexpr std::size_t kMaxNodes = 1'000'000;  // as they are written
constexpr std::size_t kMaxAliased = 100'000;  // more of them, where each alias is a copy

/// Counts what a text becomes, before any of it is made.
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

  std::map<YAML::anchor_t, std::size_t> sizes_;  // of what is complete; 0: without a name
  std::vector<std::pair<YAML::anchor_t, std::size_t>> open_;
  std::size_t count_ = 0;  // with aliases
  std::size_t aliased_ = 0;
};

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
    throw refusal(fmt::format("larger than 4 MiB, the limit of {}", what));
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
    std::istringstream events(text);
    YamlBounds bounds;
    YAML::Parser(events).HandleNextDocument(bounds);
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
