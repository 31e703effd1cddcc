// A picture that a command writes beside its report: --plot FILE.svg or FILE.png.
#pragma once

#include <optional>
#include <string>

#include "plots/chart.h"

namespace whirl_twin {

/// Throws Refusal unless the name ends in .svg or .png, before anything is computed.
void requirePictureName(const std::optional<std::string>& path);

/// FILE.svg of one system of several: FILE_SYSTEM.svg.
std::string pictureName(const std::string& path, const std::string& system, bool several);

/// Throws RunFailure. The file appears only when it is complete.
void writePicture(const std::string& path, const Figure& figure);

}  // namespace whirl_twin
