#include "reports/csv_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <utility>

#include "messages/csv_cell.h"
#include "messages/input_error.h"
#include "reports/drawings.h"
#include "reports/output.h"

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

/// FILE.csv, of a table with a name FILE_NAME.csv.
std::string csvName(const std::string& path, const std::string& table) {
  if (table.empty()) {
    return path;
  }
  std::filesystem::path name = path;
  name.replace_filename(fmt::format("{}_{}.csv", name.stem().string(), table));
  return name.string();
}

std::string csvText(const CsvTable& table) {
  std::string out = joined(table.columns, csvCell, ",") + "\n";
  for (const Json& row : table.rows) {
    out += joined(
        table.columns, [&](const std::string& column) { return cellText(row, column); }, ",");
    out += "\n";
  }
  return out;
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
    throw InputError(fmt::format("--csv: expected a name that ends in .csv, found '{}'", *path));
  }
}

void writeCsv(const std::string& path, const CsvTables& tables) {
  for (const CsvTable& table : tables) {
    writeFile(csvName(path, table.name), csvText(table));
  }
}

void requirePictureName(const std::optional<std::string>& path) {
  if (!path) {
    return;
  }
  if (figureFormat(*path).empty()) {
    throw InputError(fmt::format(
        "--plot: expected a name that ends in .svg, .png, .pdf or .json, found '{}'", *path));
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

}  // namespace whirl_twin
