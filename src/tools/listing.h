// Listings of the available names: `twin models` and `twin controllers`, as text, JSON and a table
// of parameters.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "reports/output.h"
#include "tools/command.h"

namespace whirl_twin {

/// An entry of a listing.
struct ListedThing {
  std::string name;
  std::string text;
  Json json;  ///< with "parameters", by name; a row each of the table
};

struct Listing {
  std::string kind;  ///< "model": the command is its plural, as is the key of the JSON
  const char* description;
  const char* footer;
  std::function<std::vector<ListedThing>()> all;  ///< called when the command runs
};

/// Its command accepts names, none for all; `status` receives its exit status. It throws InputError
/// with every unknown name.
void addListing(const ProgramCommand& twin, int& status, const Listing& listing);

}  // namespace whirl_twin
