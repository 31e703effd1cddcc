// Random access to a file through a moving window: the memory does not depend on the length of the
// file.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace whirl_twin {

class FileWindow {
 public:
  /// Longest range of one call of at() [bytes].
  static constexpr std::size_t kMaxLength = std::size_t{1} << 21;

  /// Throws InputError if there is no regular file at `path` that can be read.
  explicit FileWindow(const std::string& path);
  ~FileWindow();
  FileWindow(const FileWindow&) = delete;
  FileWindow& operator=(const FileWindow&) = delete;

  /// [bytes], when the file was opened.
  std::uint64_t size() const { return size_; }

  /// The bytes [offset, offset + length), all of which must lie within the file; valid until the
  /// next call. Throws InputError if they cannot be read.
  const std::uint8_t* at(std::uint64_t offset, std::size_t length);

 private:
  std::string path_;
  int file_;
  std::uint64_t size_ = 0;
  std::uint64_t begin_ = 0;
  std::vector<std::uint8_t> window_;
};

}  // namespace whirl_twin
