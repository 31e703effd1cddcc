// A file written from its beginning to its end, in which every failure to write is noticed.
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
  /// Bytes so far.
  std::uint64_t offset() const { return offset_; }

  /// Writes over what stands at an offset, and goes on at the end.
  void rewrite(std::uint64_t offset, const LittleEndian& bytes);
  /// Hands everything to the file system: only then is a full disk noticed.
  void flush();

 private:
  [[noreturn]] void fail() const;

  std::string path_;
  std::FILE* file_;
  std::uint64_t offset_ = 0;
};

}  // namespace whirl_twin
