// Values of Python from those of C++, and back.
#pragma once

#include <pybind11/pybind11.h>
#include <yaml-cpp/yaml.h>

#include <optional>
#include <string>

#include "reports/csv_table.h"
#include "reports/output.h"
#include "scene/node_reader.h"

namespace whirl_twin {

/// Text as Python has it; bytes that are not UTF-8 are replaced.
pybind11::str pythonText(const std::string& text);

/// What json.loads() makes of the command's --json: NaN and infinities are None.
pybind11::object pythonOf(const Json& json);

/// (name, {column: list of values}): numbers as they are, None for an empty cell.
pybind11::tuple pythonOf(const CsvTable& table);

/// Maps, lists and scalars of a scene; a scalar that is a number in decimal becomes one.
pybind11::object pythonOf(const YAML::Node& node);

/// A tree from mappings, sequences, arrays, numbers and text. Throws TypeError for anything else
/// and for what contains itself.
YAML::Node treeOf(const pybind11::handle& value);

/// The value in this unit of a number, or of text with a number and maybe a unit. Throws InputError
/// "NAME: must be a number (UNIT), found ...".
double quantityOf(const std::string& name, const pybind11::handle& value, const std::string& unit);

}  // namespace whirl_twin
