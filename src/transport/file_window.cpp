#include "transport/file_window.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "messages/input_error.h"

namespace whirl_twin {

FileWindow::FileWindow(const std::string& path)
    // Without O_NONBLOCK, opening a named pipe would wait for somebody to write.
    : path_(path), file_(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK)) {
  struct stat status {};
  if (file_ < 0 || ::fstat(file_, &status) != 0) {
    const std::string why = std::strerror(errno);
    if (file_ >= 0) {
      ::close(file_);
    }
    throw InputError(fmt::format("{}: cannot be read: {}", path, why));
  }
  if (!S_ISREG(status.st_mode)) {
    ::close(file_);
    throw InputError(fmt::format("{}: must be a file, found {}", path,
                                 S_ISDIR(status.st_mode) ? "a directory" : "a device"));
  }
  size_ = static_cast<std::uint64_t>(status.st_size);
}

FileWindow::~FileWindow() {
  ::close(file_);
}

const std::uint8_t* FileWindow::at(std::uint64_t offset, std::size_t length) {
  if (offset >= begin_ && offset + length <= begin_ + window_.size()) {
    return window_.data() + (offset - begin_);
  }
  begin_ = offset;
  window_.resize(std::min<std::uint64_t>(kMaxLength, size_ - offset));
  for (std::size_t filled = 0; filled < window_.size();) {
    const ssize_t got = ::pread(file_, window_.data() + filled, window_.size() - filled,
                                static_cast<off_t>(offset + filled));
    if (got < 0 && errno == EINTR) {
      continue;
    }
    if (got <= 0) {
      window_.clear();
      throw InputError(fmt::format("{}: cannot be read at byte {}: {}", path_, offset + filled,
                                   got < 0 ? std::strerror(errno) : "the file became shorter"));
    }
    filled += static_cast<std::size_t>(got);
  }
  return window_.data();
}

}  // namespace whirl_twin
