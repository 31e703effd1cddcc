// Rows of the tables that a scene gives.
#pragma once

#include <string>
#include <vector>

#include "models/settings.h"

namespace whirl_twin {

/// None of a table that is not given.
const std::vector<TableRow>& rowsOf(const Settings& settings, const std::string& name);

/// A whole number from 0 to `last` in a column of a row, which is `key` in the scene. Throws
/// SetupError.
int indexIn(const TableRow& row, const std::string& key, const char* column, int last);

/// What the numbers of a table that follow others stand for: "kyy as kxx (bearings[0])". Numbers
/// that are 0 are left out.
std::vector<std::string> followingNotes(const Settings& settings, const std::string& name);

}  // namespace whirl_twin
