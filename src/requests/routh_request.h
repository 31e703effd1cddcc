// The roots of a polynomial, counted by the Routh-Hurwitz test.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "requests/document.h"

namespace whirl_twin {

struct RouthRequest {
  std::vector<std::string> coefficients;  ///< as typed, highest power first
  std::optional<std::string> parameter;   ///< its values are found for which all roots are left
  bool insist = false;
};

/// Throws InputError for what is no coefficient, one message for each.
Document routhDocument(const RouthRequest& request);

}  // namespace whirl_twin
