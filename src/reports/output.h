// Where results go: standard output, or a file that appears only when it is complete.
#pragma once

#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>

namespace nlohmann {

/// Null where there is none.
template <class Value>
struct adl_serializer<std::optional<Value>> {
  template <class AnyJson>
  static void to_json(AnyJson& json, const std::optional<Value>& value) {
    json = value ? AnyJson(*value) : AnyJson();
  }
};

}  // namespace nlohmann

namespace whirl_twin {

/// Keys in the order they were put in; NaN and infinities are printed as null.
using Json = nlohmann::ordered_json;

/// An array of of(one) of each.
template <class All, class Of>
Json listJson(const All& all, const Of& of) {
  Json list = Json::array();
  for (const auto& one : all) {
    list.push_back(of(one));
  }
  return list;
}

/// of(one) of each, one after the other.
template <class All, class Of>
std::string joined(const All& all, const Of& of, const char* separator = "") {
  std::string text;
  const char* before = "";
  for (const auto& one : all) {
    text += before + of(one);
    before = separator;
  }
  return text;
}

/// Prints results on standard output, without what a terminal might obey (printableLines()). Throws
/// RunFailure if they cannot be written.
void printText(std::string_view text);
void printJson(const Json& json);

/// Prints a message on standard error likewise, whether it can be written or not.
void complain(const std::string& message);

/// Called with each message instead, from any thread, in a program whose standard error is not the
/// user's. To be set before other threads run.
void setMessageSink(std::function<void(const std::string&)> sink);

/// Hands everything printed to the system: only then is a full device noticed. Throws RunFailure.
void finishStandardOutput();

/// A file that is written under another name beside it and gets its own name when it is complete:
/// a run that fails leaves nothing behind, and what was there before stays. What is not a regular
/// file (a pipe, a device) is written directly.
class PendingFile {
 public:
  /// Throws RunFailure if there is no such directory or `path` is a directory.
  explicit PendingFile(const std::string& path);
  ~PendingFile();
  PendingFile(const PendingFile&) = delete;
  PendingFile& operator=(const PendingFile&) = delete;

  /// The name to write to.
  const std::string& path() const { return written_; }
  /// Gives the file its name; it must have been written entirely. Throws RunFailure.
  void complete();

 private:
  std::string final_;
  std::string written_;
  bool complete_ = false;
};

/// Writes a file that appears only when it is complete. Throws RunFailure.
void writeFile(const std::string& path, const std::string& content);

}  // namespace whirl_twin
