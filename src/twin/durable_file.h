// A file that has its name only when it is whole and on the disk: results, checkpoints.
#pragma once

#include <string>
#include <string_view>

namespace whirl_twin {

/// "PATH: cannot be written: WHY; what was finished before is kept", of an errno. RunFailure.
[[noreturn]] void throwNotWritten(const std::string& path, int error);

/// Written beside its place, under its name, the process's number and `.tmp`; gone with the object
/// if finish() was not reached. Everything throws RunFailure where the file cannot be written.
class DurableFile {
 public:
  explicit DurableFile(const std::string& path);
  ~DurableFile();
  DurableFile(const DurableFile&) = delete;
  DurableFile& operator=(const DurableFile&) = delete;

  void add(std::string_view text);
  /// On the disk when it returns, in the place of what was there.
  void finish();
  /// Likewise; false, and nothing is written, where a file of that name is there already.
  bool finishUnlessThere();

 private:
  void flush();
  void sync();
  void syncFolder();

  std::string path_;
  std::string written_;
  std::string buffer_;
  int file_ = -1;
};

}  // namespace whirl_twin
