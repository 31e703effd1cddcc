// The files of the page, read once.
#pragma once

#include <filesystem>

#include "web/web_server.h"

namespace whirl_twin {

/// Their folder: beside the installed program, or in the source that it was built from. Empty if
/// neither exists.
std::filesystem::path pageFolder();

/// The files of a folder by their paths; index.html is "/". Throws RunFailure without it.
WebFiles readPage(const std::filesystem::path& folder);

}  // namespace whirl_twin
