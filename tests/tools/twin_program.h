// Runs the built `twin` like a user, and captures its output.
#pragma once

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

namespace whirl_twin {

using Lines = std::vector<std::string>;

inline std::string contentsOf(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

inline Lines linesOf(const std::string& text) {
  Lines lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) {
    lines.push_back(line);
  }
  return lines;
}

/// A directory that is gone when the test is over.
class TemporaryDirectory {
 public:
  TemporaryDirectory() {
    std::string name = (std::filesystem::temp_directory_path() / "whirl_twin_XXXXXX").string();
    path_ = ::mkdtemp(name.data());
  }
  ~TemporaryDirectory() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  TemporaryDirectory(const TemporaryDirectory&) = delete;
  TemporaryDirectory& operator=(const TemporaryDirectory&) = delete;

  std::string file(const std::string& name) const { return (path_ / name).string(); }
  /// Writes a file and returns its path.
  std::string write(const std::string& name, const std::string& text) const {
    std::ofstream(path_ / name, std::ios::binary) << text;
    return file(name);
  }
  /// Names of the files there, sorted.
  std::vector<std::string> files() const {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(path_)) {
      names.push_back(entry.path().filename().string());
    }
    std::sort(names.begin(), names.end());
    return names;
  }

 private:
  std::filesystem::path path_;
};

/// How a run of `twin` ended.
struct Ending {
  int status = -1;  ///< exit status, or minus the signal that killed it
  std::string out;
  std::string err;

  nlohmann::json json() const { return nlohmann::json::parse(out); }
};

/// Seconds after which a run counts as hung and is killed (status -SIGALRM).
inline constexpr unsigned kHangs = 100;

/// Starts `twin` with these arguments, standard output and error into files; its process id.
inline pid_t startTwin(const std::vector<std::string>& arguments, const std::string& out,
                       const std::string& err) {
  std::vector<char*> argv{const_cast<char*>("twin")};
  for (const std::string& argument : arguments) {
    argv.push_back(const_cast<char*>(argument.c_str()));
  }
  argv.push_back(nullptr);
  const pid_t child = ::fork();
  if (child == 0) {
    ::dup2(::open(out.c_str(), O_WRONLY | O_CREAT, 0600), STDOUT_FILENO);
    ::dup2(::open(err.c_str(), O_WRONLY | O_CREAT, 0600), STDERR_FILENO);
    ::setenv("XDG_CONFIG_HOME", "/nonexistent", 0);  // no units that a user prefers
    ::alarm(kHangs);
    ::execv(WHIRL_TWIN_PROGRAM, argv.data());
    ::_exit(127);
  }
  return child;
}

/// Waits for its end: the exit status, or minus the signal that killed it.
inline int statusOf(pid_t child) {
  int ended = 0;
  ::waitpid(child, &ended, 0);
  return WIFEXITED(ended) ? WEXITSTATUS(ended) : -WTERMSIG(ended);
}

/// Runs `twin` to its end; standard output goes to the file `out_to` if there is one.
inline Ending twin(const std::vector<std::string>& arguments, const std::string& out_to = "") {
  const TemporaryDirectory scratch;
  const std::string out = out_to.empty() ? scratch.file("out") : out_to;
  const std::string err = scratch.file("err");
  const int status = statusOf(startTwin(arguments, out, err));
  return {status, out_to.empty() ? contentsOf(out) : "", contentsOf(err)};
}

inline const std::string kDemo = WHIRL_TWIN_SOURCE "/config/scenes/demo.yaml";

}  // namespace whirl_twin
