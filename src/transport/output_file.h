// Sequential output file that detects every write error.
#pragma once

#include <cstdint>
#include <cstdio>
#include <string>
#include <string_view>

#include "transport/little_endian.h"

namespace whirl_twin {

class OutputFile {
 public:
  /// Creates the file, or empties it. All throw RunFailure if it cannot be written.
  explicit OutputFile(std::string path);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  void write(const void* data, std::size_t size);
  void write(const LittleEndian& bytes) { write(bytes.data(), bytes.size()); }
  void write(std::string_view text) { write(text.data(), text.size()); }
  /// Bytes written.
  std::uint64_t offset() const { return offset_; }

  /// Overwrites bytes at an offset; the position remains at the end.
  void rewrite(std::uint64_t offset, const LittleEndian& bytes);
  /// Flushes to the file system: a full disk is detected only then.
  void flush();

 private:
  [[noreturn]] void fail() const;

  std::string path_;
  std::FILE* file_;
  std::uint64_t offset_ = 0;
};

}  // namespace whirl_twin
