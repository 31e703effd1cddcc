#include "reports/csv_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <utility>

#include "messages/csv_cell.h"
#include "messages/refusal.h"

namespace whirl_twin {

namespace {

std::string cellText(const Json& row, const std::string& column) {
  if (!row.contains(column) || row[column].is_null()) {
    return "";
  }
  const Json& cell = row[column];
  if (cell.is_number_float()) {
    return fmt::format("{}", cell.get<double>() + 0.0);  // no -0
  }
  if (!cell.is_string()) {
    return cell.dump();
  }
  return csvCell(cell.get<std::string>());
}

}  // namespace

void append(CsvTables& all, const std::string& system, const CsvTables& more) {
  for (const CsvTable& table : more) {
    auto same = std::find_if(all.begin(), all.end(),
                             [&](const CsvTable& one) { return one.name == table.name; });
    if (same == all.end()) {
      same = all.insert(all.end(), {table.name, {"system"}});
      same->columns.insert(same->columns.end(), table.columns.begin(), table.columns.end());
    }
    for (Json row : table.rows) {
      row["system"] = system;
      same->rows.push_back(std::move(row));
    }
  }
}

void requireCsvName(const std::optional<std::string>& path) {
  if (path && std::filesystem::path(*path).extension() != ".csv") {
    throw Refusal(fmt::format("--csv: expected a name that ends in .csv, found '{}'", *path));
  }
}

std::string csvName(const std::string& path, const std::string& table) {
  if (table.empty()) {
    return path;
  }
  std::filesystem::path name = path;
  name.replace_filename(fmt::format("{}_{}.csv", name.stem().string(), table));
  return name.string();
}

std::string csvText(const CsvTable& table) {
  std::string out;
  for (const std::string& column : table.columns) {
    out += (out.empty() ? "" : ",") + csvCell(column);
  }
  out += "\n";
  for (const Json& row : table.rows) {
    std::string line;
    for (const std::string& column : table.columns) {
      line += (&column == &table.columns.front() ? "" : ",") + cellText(row, column);
    }
    out += line + "\n";
  }
  return out;
}

void writeCsv(const std::string& path, const CsvTables& tables) {
  for (const CsvTable& table : tables) {
    const std::string name = csvName(path, table.name);
    PendingFile pending(name);
    std::ofstream file(pending.path(), std::ios::binary);
    file << csvText(table);
    file.close();
    if (!file) {
      throw RunFailure(fmt::format("{}: cannot be written: {}", name, std::strerror(errno)));
    }
    pending.complete();
  }
}

}  // namespace whirl_twin
