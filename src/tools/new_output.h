// An output file that replaces an existing one only on request.
#pragma once

#include <string>

namespace whirl_twin {

/// Throws InputError if there is a file or folder at `path`, unless `force`; pipes and devices are
/// allowed.
void requireNew(const std::string& option, const std::string& path, bool force);

/// A folder that is filled under a temporary name beside its final one, and renamed when complete:
/// a failed run leaves no files. If the folder exists, its files are moved in one by one.
class PendingFolder {
 public:
  /// Throws RunFailure if it cannot be created.
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
