#include "web/web_files.h"

#include <fmt/format.h>

#include <array>
#include <fstream>
#include <iterator>
#include <string>
#include <utility>

#include "messages/input_error.h"

namespace whirl_twin {

namespace fs = std::filesystem;

namespace {

constexpr std::array<std::pair<const char*, const char*>, 4> kTypes = {
    {{".html", "text/html; charset=utf-8"},
     {".js", "text/javascript; charset=utf-8"},
     {".css", "text/css; charset=utf-8"},
     {".svg", "image/svg+xml"}}};

}  // namespace

fs::path pageFolder() {
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  for (const fs::path& folder : {program.parent_path() / "../share/whirl_twin/web",
                                 program.parent_path() / "../../share/whirl_twin/web",  // of a node
                                 fs::path(WHIRL_TWIN_SOURCE_WEB)}) {
    if (fs::is_directory(folder, error)) {
      return fs::weakly_canonical(folder, error);
    }
  }
  return {};
}

WebFiles readPage(const fs::path& folder) {
  WebFiles files;
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, error)) {
    for (const auto& [extension, type] : kTypes) {
      if (entry.path().extension() == extension) {
        std::ifstream in(entry.path(), std::ios::binary);
        files["/" + entry.path().filename().string()] = {
            type, std::string(std::istreambuf_iterator<char>(in), {})};
      }
    }
  }
  const auto page = files.find("/index.html");
  if (page == files.end() || page->second.content.empty()) {
    throw RunFailure(fmt::format("the page must be in share/whirl_twin/web, found none in '{}'",
                                 folder.string()));
  }
  files["/"] = page->second;
  return files;
}

}  // namespace whirl_twin
