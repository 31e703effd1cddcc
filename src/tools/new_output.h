// A result that does not take the place of an earlier one unless it is told to.
#pragma once

#include <string>

namespace whirl_twin {

/// Throws Refusal if there is a file or folder at `path`, unless `force`; a pipe or a device is
/// none.
void requireNew(const std::string& option, const std::string& path, bool force);

/// A folder that is filled under another name beside it and gets its own when it is complete: a run
/// that fails leaves nothing behind. Into a folder that is there its files go one by one.
class PendingFolder {
 public:
  /// Throws RunFailure if it cannot be made.
  explicit PendingFolder(const std::string& path);
  ~PendingFolder();
  PendingFolder(const PendingFolder&) = delete;
  PendingFolder& operator=(const PendingFolder&) = delete;

  /// The name to write to.
  const std::string& path() const { return written_; }
  /// Throws RunFailure.
  void complete();

 private:
  std::string final_;
  std::string written_;
};

}  // namespace whirl_twin
