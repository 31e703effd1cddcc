// Parameters of a model other than single numbers: choices, names, matrices, tables of rows.
#pragma once

#include <Eigen/Core>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include "mechanics/model_description.h"

namespace whirl_twin {

/// One row of a table, such as one force of a list.
struct TableRow {
  std::map<std::string, double> numbers;
  std::map<std::string, std::string> words;
  /// Numbers that are not given and follow another of the row: kyy its kxx.
  std::map<std::string, std::string> following = {};

  /// Sets a number that is there and those that follow it. It follows no other any more.
  void set(const std::string& column, double value) {
    following.erase(column);
    numbers.at(column) = value;
    for (const auto& [follower, followed] : following) {
      if (followed == column) {
        numbers.at(follower) = value;
      }
    }
  }
};

/// As a scene gives them; what it does not give is absent, but for choices, which have a default.
struct Settings {
  std::map<std::string, std::string>
      choices;  ///< words, `true` and `false` among them, or a count as written
  std::map<std::string, Eigen::MatrixXd> matrices;
  std::map<std::string, std::vector<std::string>> names;
  std::map<std::string, std::vector<TableRow>> tables;
};

enum class SettingKind { kChoice, kMatrix, kNames, kTable, kWordOrCount };

/// The fallback of a column that must be given.
inline constexpr double kRequired = std::numeric_limits<double>::quiet_NaN();

/// A column of a table that holds numbers.
struct ColumnInfo {
  std::string name;
  std::string unit;
  Range range;
  double fallback;
  /// A column before it: unless it is given it is as that. Its fallback is then none.
  std::string fallback_column = "";
};

/// Description of a setting of a model; scene files are checked against it.
struct SettingInfo {
  std::string name;
  SettingKind kind;
  std::string unit;  ///< of a matrix's entries, in words
  std::string meaning;
  std::vector<std::string> choices = {};  ///< of a choice or instead of a count, the default first
  bool required = false;                  ///< a matrix, names or a table that must be given
  std::vector<ColumnInfo> columns = {};   ///< of a table
  std::vector<std::string> word_columns = {};    ///< of a table, all of them required
  std::vector<std::string> optional_words = {};  ///< of a table, "" unless they are given
};

// Rows of the tables that a scene gives.

/// None of a table that is not given.
const std::vector<TableRow>& rowsOf(const Settings& settings, const std::string& name);

/// A whole number from 0 to `last` in a column of a row, which is `key` in the scene. Throws
/// SetupError.
int indexIn(const TableRow& row, const std::string& key, const char* column, int last);

/// Notes on the numbers of a table that default to others: "kyy as kxx (bearings[0])". Numbers that
/// are 0 are omitted.
std::vector<std::string> followingNotes(const Settings& settings, const std::string& name);

}  // namespace whirl_twin
