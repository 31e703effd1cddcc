#include "twin/durable_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>

#include "messages/input_error.h"

namespace whirl_twin {

namespace {

constexpr std::size_t kBuffer = 1U << 20U;

}  // namespace

void throwNotWritten(const std::string& path, int error) {
  throw RunFailure(fmt::format("{}: cannot be written: {}; the previous file is kept", path,
                               std::strerror(error)));
}

DurableFile::DurableFile(const std::string& path)
    : path_(path), written_(fmt::format("{}.{}.tmp", path, ::getpid())) {
  file_ = ::open(written_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (file_ < 0) {
    throwNotWritten(path_, errno);
  }
}

DurableFile::~DurableFile() {
  if (file_ >= 0) {
    ::close(file_);
    ::unlink(written_.c_str());
  }
}

void DurableFile::add(std::string_view text) {
  buffer_ += text;
  if (buffer_.size() > kBuffer) {
    flush();
  }
}

void DurableFile::finish() {
  sync();
  if (::rename(written_.c_str(), path_.c_str()) != 0) {
    throwNotWritten(path_, errno);
  }
  ::close(file_);
  file_ = -1;
  syncFolder();
}

bool DurableFile::finishUnlessThere() {
  sync();
  if (::link(written_.c_str(), path_.c_str()) == 0) {
    syncFolder();
    return true;
  }
  if (errno == EEXIST) {
    return false;
  }
  finish();  // a file system without links
  return true;
}

void DurableFile::sync() {
  flush();
  if (::fsync(file_) != 0) {
    throwNotWritten(path_, errno);
  }
}

/// Makes the file name durable as well.
void DurableFile::syncFolder() {
  const std::string parent = std::filesystem::path(path_).parent_path().string();
  const int folder =
      ::open(parent.empty() ? "." : parent.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (folder >= 0) {
    ::fsync(folder);
    ::close(folder);
  }
}

void DurableFile::flush() {
  for (std::size_t at = 0; at < buffer_.size();) {
    const ssize_t written = ::write(file_, buffer_.data() + at, buffer_.size() - at);
    if (written < 0 && errno != EINTR) {
      throwNotWritten(path_, errno);
    }
    at += written > 0 ? static_cast<std::size_t>(written) : 0;
  }
  buffer_.clear();
}

}  // namespace whirl_twin
