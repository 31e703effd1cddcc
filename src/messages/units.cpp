#include "messages/units.h"

#include <udunits2.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstddef>
#include <map>
#include <memory>
#include <mutex>
#include <string_view>
#include <utility>

#include "messages/names.h"

namespace whirl_twin {

namespace {

struct Free {
  void operator()(ut_system* system) const { ut_free_system(system); }
  void operator()(ut_unit* unit) const { ut_free(unit); }
  void operator()(cv_converter* converter) const { cv_free(converter); }
};
using Unit = std::unique_ptr<ut_unit, Free>;

struct Definition {
  const char* symbol;
  const char* meaning;  ///< in units defined before
};

constexpr std::string_view kPerMinute = "r/min";
constexpr std::string_view kDensity = "/sqrt(Hz)";  // behind a unit, of a noise

constexpr std::size_t kRemembered = 1000;  // scales: limited, because units arrive over the network
constexpr std::array<const char*, 6> kBases = {"m", "s", "rad", "A", "K", "kg"};
constexpr std::array<std::pair<const char*, double>, 12> kPrefixes = {{{"G", 1e9},
                                                                       {"M", 1e6},
                                                                       {"k", 1e3},
                                                                       {"h", 1e2},
                                                                       {"da", 1e1},
                                                                       {"d", 1e-1},
                                                                       {"c", 1e-2},
                                                                       {"m", 1e-3},
                                                                       {"u", 1e-6},
                                                                       {"µ", 1e-6},
                                                                       {"μ", 1e-6},
                                                                       {"n", 1e-9}}};
// Inch, pound, standard gravity and the degree are exact by definition.
constexpr std::array<Definition, 50> kDefinitions = {{{"g", "0.001 kg"},
                                                      {"t", "1000 kg"},
                                                      {"min", "60 s"},
                                                      {"h", "3600 s"},
                                                      {"hr", "h"},
                                                      {"deg", "0.017453292519943295 rad"},
                                                      {"°", "deg"},
                                                      {"rev", "6.283185307179586 rad"},
                                                      {"rpm", "rev/min"},
                                                      {"RPM", "rpm"},
                                                      {"rps", "rev/s"},
                                                      {"Hz", "rev/s"},
                                                      {"cpm", "rev/min"},
                                                      {"N", "kg m/s^2"},
                                                      {"Nm", "N m"},
                                                      {"gmm", "0.000001 kg m"},
                                                      {"Pa", "N/m^2"},
                                                      {"bar", "100000 Pa"},
                                                      {"J", "N m"},
                                                      {"W", "J/s"},
                                                      {"V", "W/A"},
                                                      {"Ohm", "V/A"},
                                                      {"H", "V s/A"},
                                                      {"T", "V s/m^2"},
                                                      {"P", "0.1 Pa s"},
                                                      {"l", "0.001 m^3"},
                                                      {"L", "0.001 m^3"},
                                                      {"in", "0.0254 m"},
                                                      {"inch", "0.0254 m"},
                                                      {"inches", "in"},
                                                      {"mil", "0.0000254 m"},
                                                      {"mils", "mil"},
                                                      {"thou", "mil"},
                                                      {"micron", "0.000001 m"},
                                                      {"microns", "micron"},
                                                      {"ft", "0.3048 m"},
                                                      {"lb", "0.45359237 kg"},
                                                      {"lbm", "lb"},
                                                      {"oz", "0.028349523125 kg"},
                                                      {"lbf", "4.4482216152605 N"},
                                                      {"ozf", "0.0625 lbf"},
                                                      {"kgf", "9.80665 N"},
                                                      {"psi", "lbf/in^2"},
                                                      {"ksi", "1000 psi"},
                                                      {"reyn", "psi s"},
                                                      {"hp", "550 ft lbf/s"},
                                                      {"degree", "deg"},
                                                      {"degrees", "deg"},
                                                      {"%", "0.01"},
                                                      {"percent", "%"}}};

/// The library is not thread-safe; nor are its results.
class Units {
 public:
  Units() {
    ut_set_error_message_handler(ut_ignore);
    system_.reset(ut_new_system());
    for (const char* symbol : kBases) {
      name(symbol, Unit(ut_new_base_unit(system_.get())));
    }
    for (const auto& [symbol, value] : kPrefixes) {
      ut_add_symbol_prefix(system_.get(), symbol, value);
    }
    for (const Definition& unit : kDefinitions) {
      name(unit.symbol, parsed(unit.meaning));
    }
  }

  bool has(const std::string& unit) {
    const std::lock_guard<std::mutex> lock(mutex_);
    return parsed(unit) != nullptr;
  }

  double scale(const std::string& unit, const std::string& wanted) {
    const std::lock_guard<std::mutex> lock(mutex_);
    const auto found = scales_.find({unit, wanted});
    if (found != scales_.end()) {
      return found->second;
    }
    const double scale = converted(unit, wanted);
    if (scales_.size() < kRemembered) {
      scales_.emplace(std::pair(unit, wanted), scale);
    }
    return scale;
  }

 private:
  void name(const char* symbol, const Unit& unit) {
    ut_map_symbol_to_unit(symbol, UT_UTF8, unit.get());
  }

  Unit parsed(const std::string& unit) const {
    // "of its value": of a ratio
    std::string text = unit == "-" || unit.rfind("of ", 0) == 0 ? "" : unit;
    if (text.compare(0, kPerMinute.size(), kPerMinute) ==
        0) {  // a symbol r would be one in mr, too
      text.replace(0, kPerMinute.size(), "rev/min");
    }
    return Unit(ut_parse(system_.get(), text.c_str(), UT_UTF8));
  }

  /// 0 also for scales with an offset.
  double converted(const std::string& unit, const std::string& wanted) const {
    const Unit from = parsed(unit), to = parsed(wanted);
    if (!from || !to || ut_are_convertible(from.get(), to.get()) == 0) {
      return 0.0;
    }
    const std::unique_ptr<cv_converter, Free> way(ut_get_converter(from.get(), to.get()));
    return way && cv_convert_double(way.get(), 0.0) == 0.0 ? cv_convert_double(way.get(), 1.0)
                                                           : 0.0;
  }

  std::unique_ptr<ut_system, Free> system_;
  std::mutex mutex_;
  std::map<std::pair<std::string, std::string>, double> scales_;
};

Units& units() {
  static Units all;
  return all;
}

/// Whether a factor, which is a number and no exponent, follows at `at`: in "m 3", "m/2".
bool isFactor(const std::string& text, std::size_t at) {
  return std::isdigit(static_cast<unsigned char>(text[at])) != 0 &&
         std::string("*/. (").find(text[at - 1]) != std::string::npos;
}

/// Whether a function's argument begins at `at`, as in "lg(mW)"; not a product's, as in "um/(g m)".
bool isArgument(const std::string& text, std::size_t at) {
  return text[at] == '(' && std::string("*/. ").find(text[at - 1]) == std::string::npos;
}

/// Excludes numbers, products with numbers and sums: "1/s" is a unit, "10", "-m", "m 3" and "m + 1"
/// are not.
bool looksLikeUnit(const std::string& text) {
  const bool reciprocal = text.compare(0, 2, "1/") == 0;
  const std::size_t begin = reciprocal ? 2 : 0;
  if (text.size() <= begin || text.find_first_of("+@,;:#'\"\t\n\v\f\r") != std::string::npos ||
      std::string("0123456789.-*/^ ()").find(text[begin]) != std::string::npos) {
    return false;
  }
  for (std::size_t i = begin + 1; i < text.size(); ++i) {
    if (isFactor(text, i) || isArgument(text, i)) {
      return false;
    }
  }
  return printable(text, text.size()) == text;  // the parser stops at an invalid byte
}

bool endsAsDensity(const std::string& unit) {
  return unit.size() > kDensity.size() &&
         unit.compare(unit.size() - kDensity.size(), kDensity.size(), kDensity) == 0;
}
std::string withoutDensity(const std::string& unit) {
  return unit.substr(0, unit.size() - kDensity.size());
}

std::string lowerCase(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

}  // namespace

bool isUnit(const std::string& text) {
  return endsAsDensity(text) ? isUnit(withoutDensity(text))
                             : looksLikeUnit(text) && units().has(text);
}

double unitScale(const std::string& unit, const std::string& wanted) {
  if (unit.empty() || unit == wanted) {
    return 1.0;
  }
  if (endsAsDensity(unit) || endsAsDensity(wanted)) {
    return endsAsDensity(unit) && endsAsDensity(wanted)
               ? unitScale(withoutDensity(unit), withoutDensity(wanted))
               : 0.0;
  }
  return units().scale(unit, wanted);
}

const std::vector<QuantityUnits>& unitsByQuantity() {
  static const std::vector<QuantityUnits> all = {
      {"a length",
       "m",
       {"mm", "cm", "um", "µm", "micron", "microns", "in", "inch", "inches", "mil", "mils", "thou",
        "ft"}},
      {"a mass", "kg", {"g", "t", "lb", "lbm", "oz"}},
      {"a time", "s", {"ns", "us", "ms", "min", "h", "hr"}},
      {"an angle", "rad", {"mrad", "deg", "degree", "degrees", "°", "rev"}},
      {"an angular speed",
       "rad/s",
       {"rpm", "RPM", "rev/min", "r/min", "cpm", "rps", "Hz", "kHz", "deg/s"}},
      {"an angular acceleration", "rad/s^2", {"rpm/s", "r/min/s", "Hz/s", "deg/s^2"}},
      {"a speed", "m/s", {"mm/s", "in/s"}},
      {"an acceleration", "m/s^2", {"mm/s^2", "in/s^2"}},
      {"a mass times radius", "kg m", {"g mm", "gmm", "g m", "kg mm", "oz in", "lb in"}},
      {"a moment of inertia", "kg m^2", {"kg mm^2", "kg cm^2", "g mm^2", "lb in^2"}},
      {"a density", "kg/m^3", {"g/cm^3", "lb/in^3"}},
      {"a force", "N", {"kN", "kgf", "lbf", "ozf"}},
      {"a torque or an energy", "N m", {"Nm", "kNm", "N mm", "J", "lbf in", "lbf ft"}},
      {"a stiffness", "N/m", {"N/mm", "kN/mm", "MN/m", "lbf/in"}},
      {"a damping coefficient", "N s/m", {"N s/mm", "lbf s/in"}},
      {"a torsional stiffness", "N m/rad", {"kN m/rad", "lbf in/rad"}},
      {"a torsional damping coefficient", "N m s/rad", {"lbf in s/rad"}},
      {"a pressure", "Pa", {"kPa", "MPa", "GPa", "bar", "psi", "ksi"}},
      {"a viscosity", "Pa s", {"mPa s", "P", "cP", "reyn"}},
      {"a power", "W", {"kW", "MW", "hp"}},
      {"a volume", "m^3", {"l", "L", "cm^3"}},
      {"a temperature difference", "K", {"mK"}},
      {"a current", "A", {"mA"}},
      {"a voltage", "V", {"mV"}},
      {"a resistance", "Ohm", {"kOhm"}},
      {"an inductance", "H", {"mH"}},
      {"a magnetic flux density", "T", {"mT"}},
      {"a rate", "1/s", {"1/min"}},
      {"a ratio", "-", {"%", "percent"}}};
  return all;
}

std::string quantityName(const std::string& unit) {
  if (unit.empty() || !isUnit(unit)) {
    return "";
  }
  for (const QuantityUnits& quantity : unitsByQuantity()) {
    if (unitScale(unit, quantity.unit) != 0.0) {
      return quantity.name;
    }
  }
  return "";
}

std::string unitMeant(const std::string& unit, const std::string& wanted) {
  // A pound and a kilogram are masses; in "lb/in" a force is meant.
  constexpr std::array<std::pair<const char*, const char*>, 6> kForces = {
      {{"lbm", "lbf"}, {"lbf", "lb"}, {"lb", "lbf"}, {"kgf", "kg"}, {"kg", "kgf"}, {"oz", "ozf"}}};
  for (const auto& [written, meant] : kForces) {
    const std::size_t at = unit.find(written);
    if (at != std::string::npos) {
      std::string other = unit;
      other.replace(at, std::string(written).size(), meant);
      if (isUnit(other) && unitScale(other, wanted) != 0.0) {
        return other;
      }
    }
  }
  for (const QuantityUnits& quantity : unitsByQuantity()) {
    if (unitScale(quantity.unit, wanted) != 0.0) {
      const auto found =
          std::find_if(quantity.units.begin(), quantity.units.end(),
                       [&](const char* known) { return lowerCase(known) == lowerCase(unit); });
      if (found != quantity.units.end() && unit != *found) {
        return *found;
      }
    }
  }
  return "";
}

}  // namespace whirl_twin
