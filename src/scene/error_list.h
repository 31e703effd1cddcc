// Errors in a message: a limited number of them, because a file that is something else has many.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace whirl_twin {

inline constexpr std::size_t kMaxErrorsShown = 10;

/// The first of them and "and N more", each after `between` but the first.
std::string errorList(const std::vector<std::string>& errors, const std::string& between = "\n");

}  // namespace whirl_twin
