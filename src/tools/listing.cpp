#include "tools/listing.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <memory>
#include <optional>

#include "messages/input_error.h"
#include "messages/names.h"
#include "reports/csv_table.h"
#include "tools/arguments.h"
#include "tools/commands.h"

namespace whirl_twin {

namespace {

struct ListingRequest {
  std::vector<std::string> names;  // none: all of them
  std::optional<std::string> csv;
  bool json = false;
};

bool isIn(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

void requireNames(const std::string& kind, const std::vector<std::string>& asked,
                  const std::vector<ListedThing>& things) {
  std::vector<std::string> names;
  for (const ListedThing& thing : things) {
    names.push_back(thing.name);
  }
  std::vector<std::string> errors;
  for (const std::string& name : asked) {
    if (!isIn(names, name)) {
      errors.push_back(fmt::format("no {} '{}'{}", kind, name, hint(name, names)));
    }
  }
  if (!errors.empty()) {
    throw InputError(fmt::format("{}", fmt::join(errors, "\ntwin: ")));
  }
}

int list(const Listing& listing, const ListingRequest& request) {
  const std::vector<ListedThing> things = listing.all();
  requireNames(listing.kind, request.names, things);
  requireCsvName(request.csv);
  Json all;
  std::string texts;
  CsvTable parameters{
      "", {listing.kind, "parameter", "unit", "range", "default", "required", "meaning"}};
  for (const ListedThing& thing : things) {
    if (!request.names.empty() && !isIn(request.names, thing.name)) {
      continue;
    }
    all[listing.kind + "s"][thing.name] = thing.json;
    texts += (texts.empty() ? "" : "\n") + thing.text;
    const Json of_it = thing.json.value("parameters", Json::object());
    for (const auto& [name, parameter] : of_it.items()) {
      Json row = parameter;
      row.update({{listing.kind, thing.name}, {"parameter", name}});
      parameters.rows.push_back(row);
    }
  }
  if (request.csv) {
    writeCsv(*request.csv, {parameters});
  }
  if (request.json) {
    printJson(all);
  } else {
    printText(texts);
  }
  return kDone;
}

std::string upper(std::string word) {
  std::transform(word.begin(), word.end(), word.begin(),
                 [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  return word;
}

}  // namespace

void addListing(const ProgramCommand& twin, int& status, const Listing& listing) {
  const ProgramCommand command = twin.subcommand(listing.kind + "s", listing.description);
  const auto request = std::make_shared<ListingRequest>();
  command.option(upper(listing.kind), request->names, "only these " + listing.kind + "s").type("");
  addCsvOption(command, request->csv);
  command.flag("--json", request->json, "print one JSON object");
  command.footer(listing.footer);
  command.callback([listing, request, &status] { status = list(listing, *request); });
}

}  // namespace whirl_twin
