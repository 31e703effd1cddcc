// What a scene can name, listed: `twin models` and `twin controllers`, as text, JSON and a table of
// parameters.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "reports/output.h"
#include "tools/command.h"

namespace whirl_twin {

/// One thing that can be named.
struct ListedThing {
  std::string name;
  std::string text;
  Json json;  ///< with "parameters", by name; a row each of the table
};

struct Listing {
  std::string kind;  ///< "model": the command is its plural, as is the key of the JSON
  const char* description;
  const char* footer;
  std::function<std::vector<ListedThing>()> all;  ///< asked when the command runs
};

/// Its command takes names, none for all; `status` gets its exit status. It throws Refusal with
/// every name that there is not.
void addListing(const ProgramCommand& twin, int& status, const Listing& listing);

}  // namespace whirl_twin
