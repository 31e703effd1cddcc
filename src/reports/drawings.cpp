#include "reports/drawings.h"

#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <utility>

#include "messages/input_error.h"

namespace whirl_twin {

namespace {

namespace fs = std::filesystem;

constexpr const char* kNeeds =
    "figures need python3-matplotlib: sudo apt-get install python3-matplotlib";

using OwnedFile = std::unique_ptr<std::FILE, int (*)(std::FILE*)>;

OwnedFile temporaryFile() {
  OwnedFile file(std::tmpfile(), std::fclose);
  if (!file) {
    throw RunFailure(fmt::format("a temporary file cannot be created: {}", std::strerror(errno)));
  }
  return file;
}

/// The folder of the Python package: of an installation, else of the sources.
std::string packageFolder() {
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  const fs::path installed = program.parent_path() / "../lib/python3/dist-packages";
  return fs::exists(installed / "whirl_twin/drawing", error) ? installed.string()
                                                             : WHIRL_TWIN_SOURCE_PYTHON;
}

/// The environment of this process, with the package first on Python's path. Python does not search
/// the current folder: a json.py there would be run.
std::vector<std::string> pythonEnvironment() {
  std::vector<std::string> all{"PYTHONSAFEPATH=1"};
  std::string path = "PYTHONPATH=" + packageFolder();
  for (char** one = environ; *one != nullptr; ++one) {
    const std::string variable = *one;
    if (variable.rfind("PYTHONPATH=", 0) == 0) {
      path += ":" + variable.substr(std::strlen("PYTHONPATH="));
    } else if (variable.rfind("PYTHONSAFEPATH=", 0) != 0) {
      all.push_back(variable);
    }
  }
  all.push_back(path);
  return all;
}

std::vector<char*> pointersTo(std::vector<std::string>& texts) {
  std::vector<char*> pointers;
  for (std::string& text : texts) {
    pointers.push_back(text.data());
  }
  pointers.push_back(nullptr);
  return pointers;
}

/// The last line that is not empty.
std::string lastLine(std::FILE* file) {
  std::rewind(file);
  std::string last, line;
  std::array<char, 4096> part{};
  while (std::fgets(part.data(), static_cast<int>(part.size()), file) != nullptr) {
    line += part.data();
    if (line.back() == '\n') {
      line.pop_back();
      last = line.empty() ? last : line;
      line.clear();
    }
  }
  return line.empty() ? last : line;
}

/// Runs the drawing program on the request. Throws RunFailure with its message.
void drawByPython(const Json& drawings) {
  const OwnedFile input = temporaryFile();
  const OwnedFile output = temporaryFile();
  const OwnedFile errors = temporaryFile();
  const std::string request = Json{{"drawings", drawings}}.dump(
      -1, ' ', false, Json::error_handler_t::replace);  // names of files need not be UTF-8
  if (std::fwrite(request.data(), 1, request.size(), input.get()) != request.size() ||
      std::fflush(input.get()) != 0) {
    throw RunFailure(fmt::format("a temporary file cannot be written: {}", std::strerror(errno)));
  }
  std::rewind(input.get());

  const char* chosen = std::getenv("WHIRL_TWIN_PYTHON");
  std::vector<std::string> command{chosen != nullptr ? chosen : WHIRL_TWIN_PYTHON, "-m",
                                   "whirl_twin.drawing"};
  std::vector<std::string> environment = pythonEnvironment();
  posix_spawn_file_actions_t files;
  ::posix_spawn_file_actions_init(&files);
  ::posix_spawn_file_actions_adddup2(&files, ::fileno(input.get()), 0);
  ::posix_spawn_file_actions_adddup2(&files, ::fileno(output.get()), 1);
  ::posix_spawn_file_actions_adddup2(&files, ::fileno(errors.get()), 2);
  pid_t child = 0;
  const int failed = ::posix_spawn(&child, command.front().c_str(), &files, nullptr,
                                   pointersTo(command).data(), pointersTo(environment).data());
  ::posix_spawn_file_actions_destroy(&files);
  if (failed != 0) {
    throw RunFailure(fmt::format("{} ({}: {})", kNeeds, command.front(), std::strerror(failed)));
  }
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) {
    const std::string why = lastLine(errors.get());
    throw RunFailure("figures cannot be drawn: " + (why.empty() ? "Python was ended" : why));
  }
}

}  // namespace

void Drawings::await(const std::string& path, const std::string& format, const char* key,
                     const Json& data) {
  files_.push_back({path, std::make_unique<PendingFile>(path)});
  const std::string& written = files_.back().pending->path();
  if (format != "json") {
    request_.push_back({{"path", written}, {"format", format}, {key, data}});
    return;
  }
  std::ofstream file(written, std::ios::binary);
  file << data.dump(-1, ' ', false, Json::error_handler_t::replace) << '\n';
  file.close();
  if (!file) {
    throw RunFailure(fmt::format("{}: cannot be written: {}", path, std::strerror(errno)));
  }
}

void Drawings::add(const std::string& path, const Json& figure) {
  await(path, figureFormat(path), "figure", figure);
}

void Drawings::addOverlaid(const std::string& path, const Json& figures_by_name) {
  await(path, figureFormat(path), "figures", figures_by_name);
}

void Drawings::addPage(const std::string& path, const Json& page) {
  await(path, "html", "page", page);
}

std::vector<std::string> Drawings::write() {
  if (!request_.empty()) {
    drawByPython(request_);
  }
  std::vector<std::string> paths;
  for (const File& file : files_) {
    file.pending->complete();
    paths.push_back(file.path);
  }
  files_.clear();
  request_.clear();
  return paths;
}

std::string figureFormat(const std::string& path) {
  const std::string extension = fs::path(path).extension().string();
  for (const char* format : {"svg", "png", "pdf", "json"}) {
    if (extension == std::string(".") + format) {
      return format;
    }
  }
  return "";
}

}  // namespace whirl_twin
