#include "reports/picture_file.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "messages/refusal.h"
#include "reports/output.h"

namespace whirl_twin {

void requirePictureName(const std::optional<std::string>& path) {
  if (!path) {
    return;
  }
  const std::string extension = std::filesystem::path(*path).extension().string();
  if (extension != ".svg" && extension != ".png") {
    throw Refusal(
        fmt::format("--plot: expected a name that ends in .svg or .png, found '{}'", *path));
  }
}

std::string pictureName(const std::string& path, const std::string& system, bool several) {
  if (!several) {
    return path;
  }
  std::filesystem::path name = path;
  name.replace_filename(
      fmt::format("{}_{}{}", name.stem().string(), system, name.extension().string()));
  return name.string();
}

void writePicture(const std::string& path, const Figure& figure) {
  PendingFile pending(path);
  std::ofstream file(pending.path(), std::ios::binary);
  file << figureImage(figure, imageFormat(path));
  file.close();
  if (!file) {
    throw RunFailure(fmt::format("{}: cannot be written: {}", path, std::strerror(errno)));
  }
  pending.complete();
}

}  // namespace whirl_twin
