#include "tools/new_output.h"

#include <fmt/format.h>
#include <unistd.h>

#include <filesystem>

#include "messages/input_error.h"

namespace whirl_twin {

namespace fs = std::filesystem;

void requireNew(const std::string& option, const std::string& path, bool force) {
  std::error_code ignored;
  const fs::file_status status = fs::status(path, ignored);
  if (!force && (fs::is_regular_file(status) || fs::is_directory(status))) {
    throw InputError(fmt::format("{}: '{}' exists; --force overwrites it", option, path));
  }
}

PendingFolder::PendingFolder(const std::string& path) : final_(fs::path(path) / "") {
  final_.pop_back();  // the slash
  written_ = fmt::format("{}.{}.part", final_, ::getpid());
  std::error_code error;
  if (fs::exists(final_, error) && !fs::is_directory(final_, error)) {
    throw RunFailure(fmt::format("{}: cannot be written: not a folder", final_));
  }
  if (!fs::create_directory(written_, error)) {
    throw RunFailure(fmt::format("{}: cannot be written: {}", final_, error.message()));
  }
}

PendingFolder::~PendingFolder() {
  std::error_code ignored;
  fs::remove_all(written_, ignored);
}

void PendingFolder::complete() {
  std::error_code error;
  if (!fs::exists(final_, error)) {
    fs::rename(written_, final_, error);
  } else {
    for (const auto& file : fs::directory_iterator(written_)) {
      if (!error) {
        fs::rename(file.path(), fs::path(final_) / file.path().filename(), error);
      }
    }
  }
  if (error) {
    throw RunFailure(fmt::format("{}: cannot be written: {}", final_, error.message()));
  }
}

}  // namespace whirl_twin
