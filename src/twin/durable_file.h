// A file that gets its name only once it is complete and on the disk: for results and checkpoints.
#pragma once

#include <string>
#include <string_view>

namespace whirl_twin {

/// "PATH: cannot be written: WHY; what was finished before is kept", of an errno. RunFailure.
[[noreturn]] void throwNotWritten(const std::string& path, int error);

/// Written next to its destination as NAME.PID.tmp; deleted by the destructor unless finish() was
/// reached. All members throw RunFailure if the file cannot be written.
class DurableFile {
 public:
  explicit DurableFile(const std::string& path);
  ~DurableFile();
  DurableFile(const DurableFile&) = delete;
  DurableFile& operator=(const DurableFile&) = delete;

  void add(std::string_view text);
  /// On the disk on return; replaces an existing file.
  void finish();
  /// Likewise; returns false, without writing, if the file already exists.
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
