#include "python/conversions.h"

#include <fmt/format.h>

#include <cmath>

#include "messages/input_error.h"
#include "messages/names.h"

namespace py = pybind11;

namespace whirl_twin {

namespace {

constexpr int kDeepest = 64;  // levels, as of a scene file

py::object numberOf(const Json& json, bool keep_infinite) {
  const auto value = json.get<double>();
  if (!keep_infinite && !std::isfinite(value)) {
    return py::none();
  }
  return py::float_(value);
}

py::object converted(const Json& json, bool keep_infinite) {
  switch (json.type()) {
    case Json::value_t::object: {
      py::dict all;
      for (const auto& [key, value] : json.items()) {
        all[pythonText(key)] = converted(value, keep_infinite);
      }
      return std::move(all);
    }
    case Json::value_t::array: {
      py::list all(json.size());
      for (std::size_t i = 0; i < json.size(); ++i) {
        all[i] = converted(json[i], keep_infinite);
      }
      return std::move(all);
    }
    case Json::value_t::string:
      return pythonText(json.get_ref<const std::string&>());
    case Json::value_t::boolean:
      return py::bool_(json.get<bool>());
    case Json::value_t::number_integer:
      return py::int_(json.get<std::int64_t>());
    case Json::value_t::number_unsigned:
      return py::int_(json.get<std::uint64_t>());
    case Json::value_t::number_float:
      return numberOf(json, keep_infinite);
    default:
      return py::none();
  }
}

[[noreturn]] void throwType(const char* expected, const py::handle& value) {
  throw py::type_error(
      fmt::format("a scene has {}, found {}", expected,
                  std::string(py::str(py::type::handle_of(value).attr("__name__")))));
}

/// Numbers of NumPy are numbers of Python by item(), arrays are lists by tolist().
YAML::Node treeAt(const py::handle& value, int depth) {
  if (depth > kDeepest) {
    throw py::type_error(fmt::format("a scene is nested at most {} deep", kDeepest));
  }
  if (value.is_none()) {
    return YAML::Node(YAML::NodeType::Null);
  }
  if (py::isinstance<py::bool_>(value)) {
    return YAML::Node(value.cast<bool>() ? "true" : "false");
  }
  if (py::isinstance<py::str>(value)) {
    return YAML::Node(value.cast<std::string>());
  }
  if (py::isinstance<py::float_>(value)) {  // the shortest text that reads back as the same
    return YAML::Node(std::string(py::repr(py::float_(value.cast<double>()))));
  }
  if (py::isinstance<py::int_>(value)) {
    return YAML::Node(std::string(py::str(value)));
  }
  if (PyMapping_Check(value.ptr()) != 0 && py::hasattr(value, "items")) {
    YAML::Node tree(YAML::NodeType::Map);
    for (const py::handle item : py::reinterpret_steal<py::list>(PyMapping_Items(value.ptr()))) {
      const py::handle key = py::reinterpret_borrow<py::tuple>(item)[0];
      if (!py::isinstance<py::str>(key)) {
        throwType("keys of text", key);
      }
      tree.force_insert(key.cast<std::string>(),
                        treeAt(py::reinterpret_borrow<py::tuple>(item)[1], depth + 1));
    }
    return tree;
  }
  if (py::hasattr(value, "tolist")) {
    return treeAt(value.attr("tolist")(), depth + 1);
  }
  if (py::isinstance<py::list>(value) || py::isinstance<py::tuple>(value)) {
    YAML::Node tree(YAML::NodeType::Sequence);
    for (const py::handle entry : value) {
      tree.push_back(treeAt(entry, depth + 1));
    }
    return tree;
  }
  throwType("mappings, lists, numbers and text", value);
}

}  // namespace

py::str pythonText(const std::string& text) {
  PyObject* const decoded =
      PyUnicode_DecodeUTF8(text.data(), static_cast<Py_ssize_t>(text.size()), "replace");
  if (decoded == nullptr) {
    throw py::error_already_set();
  }
  return py::reinterpret_steal<py::str>(decoded);
}

py::object pythonOf(const Json& json) {
  return converted(json, false);
}

py::tuple pythonOf(const CsvTable& table) {
  py::dict columns;
  for (const std::string& name : table.columns) {
    py::list column;
    for (const Json& row : table.rows) {
      const auto cell = row.find(name);
      column.append(cell == row.end() ? py::object(py::none()) : converted(*cell, true));
    }
    columns[pythonText(name)] = column;
  }
  return py::make_tuple(pythonText(table.name), columns);
}

py::object pythonOf(const YAML::Node& node) {
  if (node.IsMap()) {
    py::dict all;
    for (const auto& entry : node) {
      all[pythonText(entry.first.Scalar())] = pythonOf(entry.second);
    }
    return std::move(all);
  }
  if (node.IsSequence()) {
    py::list all;
    for (const YAML::Node& entry : node) {
      all.append(pythonOf(entry));
    }
    return std::move(all);
  }
  if (!node.IsDefined() || node.IsNull()) {
    return py::none();
  }
  const std::string& text = node.Scalar();
  if (text == "true" || text == "false") {
    return py::bool_(text == "true");
  }
  if (const std::optional<double> number = parseNumber(text)) {
    const bool whole = text.find_first_not_of("+-0123456789") == std::string::npos;
    return whole ? py::object(py::int_(py::str(text))) : py::object(py::float_(*number));
  }
  return pythonText(text);
}

YAML::Node treeOf(const py::handle& value) {
  return treeAt(value, 0);
}

double quantityOf(const std::string& name, const py::handle& value, const std::string& unit) {
  if (py::isinstance<py::str>(value)) {
    const auto text = value.cast<std::string>();
    if (const std::optional<double> number = parseQuantity(text, unit)) {
      return *number;
    }
    throw InputError(fmt::format("{}: must be a number ({}), found '{}'{}", name, unit,
                                 printable(text), unitDiagnostic(YAML::Node(text), unit)));
  }
  const double number =
      py::isinstance<py::bool_>(value) || PyNumber_Check(value.ptr()) == 0
          ? throw py::type_error(
                fmt::format("{}: must be a number ({}) or text with a unit, found {}", name, unit,
                            std::string(py::str(py::type::handle_of(value).attr("__name__")))))
          : py::float_(py::reinterpret_borrow<py::object>(value)).cast<double>();
  if (!std::isfinite(number)) {
    throw InputError(fmt::format("{}: must be a finite number ({}), found {}", name, unit, number));
  }
  return number;
}

}  // namespace whirl_twin
