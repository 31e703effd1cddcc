#include "reports/output.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <utility>

#include "messages/input_error.h"
#include "messages/names.h"

namespace whirl_twin {

namespace {

std::function<void(const std::string&)> message_sink;

[[noreturn]] void throwNoOutput() {
  throw RunFailure(fmt::format("standard output: cannot be written: {}", std::strerror(errno)));
}

}  // namespace

void printText(std::string_view text) {
  const std::string shown = printableLines(text);
  if (std::fwrite(shown.data(), 1, shown.size(), stdout) != shown.size()) {
    throwNoOutput();
  }
}

void printJson(const Json& json) {
  // Names in a scene may hold any bytes: what is not UTF-8 is replaced, not refused, and what a
  // terminal might obey goes as \uXXXX like all that is not ASCII.
  printText(json.dump(2, ' ', true, Json::error_handler_t::replace) + "\n");
}

void complain(const std::string& message) {
  const std::string shown = printableLines(message);
  if (message_sink) {
    message_sink(shown);
    return;
  }
  std::fwrite(shown.data(), 1, shown.size(), stderr);
  std::fflush(stderr);
}

void setMessageSink(std::function<void(const std::string&)> sink) {
  message_sink = std::move(sink);
}

void finishStandardOutput() {
  if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0) {
    throwNoOutput();
  }
}

PendingFile::PendingFile(const std::string& path) : final_(path), written_(path) {
  namespace fs = std::filesystem;
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (fs::is_directory(status)) {
    throw RunFailure(fmt::format("{}: cannot be written: it is a directory", path));
  }
  if (fs::exists(status) && !fs::is_regular_file(status)) {
    complete_ = true;  // there is nothing to rename
    return;
  }
  if (fs::exists(status)) {
    if (::access(path.c_str(), W_OK) != 0) {
      throw RunFailure(fmt::format("{}: cannot be written: {}", path, std::strerror(errno)));
    }
    final_ = fs::canonical(path, error).string();  // a link stays a link
  }
  const fs::path directory = fs::path(final_).parent_path();
  if (!directory.empty() && !fs::is_directory(directory, error)) {
    throw RunFailure(
        fmt::format("{}: cannot be written: no directory {}", path, directory.string()));
  }
  written_ = fmt::format("{}.{}.part", final_, ::getpid());
}

PendingFile::~PendingFile() {
  if (!complete_) {
    std::remove(written_.c_str());
  }
}

void PendingFile::complete() {
  if (complete_) {
    return;
  }
  if (std::rename(written_.c_str(), final_.c_str()) != 0) {
    throw RunFailure(fmt::format("{}: cannot be written: {}", final_, std::strerror(errno)));
  }
  complete_ = true;
}

void writeFile(const std::string& path, const std::string& content) {
  PendingFile pending(path);
  std::ofstream file(pending.path(), std::ios::binary);
  file << content;
  file.close();
  if (!file) {
    throw RunFailure(fmt::format("{}: cannot be written: {}", path, std::strerror(errno)));
  }
  pending.complete();
}

}  // namespace whirl_twin
