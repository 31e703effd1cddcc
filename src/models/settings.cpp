#include "models/settings.h"

#include <fmt/format.h>

#include <cmath>

#include "models/model_info.h"

namespace whirl_twin {

const std::vector<TableRow>& rowsOf(const Settings& settings, const std::string& name) {
  static const std::vector<TableRow> none;
  const auto found = settings.tables.find(name);
  return found == settings.tables.end() ? none : found->second;
}

int indexIn(const TableRow& row, const std::string& key, const char* column, int last) {
  const double number = row.numbers.at(column);
  if (!(number >= 0.0 && number <= last && number == std::floor(number))) {
    throw SetupError(fmt::format("{}.{}", key, column),
                     fmt::format("must be a whole number from 0 to {}, found {}", last, number));
  }
  return static_cast<int>(number);
}

std::vector<std::string> followingNotes(const Settings& settings, const std::string& name) {
  std::map<std::string, std::vector<std::size_t>> rows;  // by their text
  const std::vector<TableRow>& table = rowsOf(settings, name);
  for (std::size_t i = 0; i < table.size(); ++i) {
    for (const auto& [follower, followed] : table[i].following) {
      if (table[i].numbers.at(follower) != 0.0) {
        rows[fmt::format("{} as {}", follower, followed)].push_back(i);
      }
    }
  }
  std::vector<std::string> notes;
  for (const auto& [what, where] : rows) {
    notes.push_back(
        fmt::format("{}, default ({}[{}]{})", what, name, where.front(),
                    where.size() > 1 ? fmt::format(" and {} more", where.size() - 1) : ""));
  }
  return notes;
}

}  // namespace whirl_twin
