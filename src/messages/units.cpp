#include "messages/units.h"

#include <udunits2.h>

#include <array>
#include <cstddef>
#include <map>
#include <memory>
#include <mutex>
#include <utility>

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
constexpr std::array<Definition, 34> kDefinitions = {{{"g", "0.001 kg"},
                                                      {"t", "1000 kg"},
                                                      {"min", "60 s"},
                                                      {"deg", "0.017453292519943295 rad"},
                                                      {"°", "deg"},
                                                      {"rev", "6.283185307179586 rad"},
                                                      {"rpm", "rev/min"},
                                                      {"Hz", "rev/s"},
                                                      {"cpm", "rev/min"},
                                                      {"N", "kg m/s^2"},
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
                                                      {"mil", "0.0000254 m"},
                                                      {"ft", "0.3048 m"},
                                                      {"lb", "0.45359237 kg"},
                                                      {"lbm", "lb"},
                                                      {"oz", "0.028349523125 kg"},
                                                      {"lbf", "4.4482216152605 N"},
                                                      {"kgf", "9.80665 N"},
                                                      {"psi", "lbf/in^2"},
                                                      {"ksi", "1000 psi"},
                                                      {"reyn", "psi s"},
                                                      {"%", "0.01"}}};

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
    const std::string text = unit == "-" ? "" : unit;
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

/// Excludes numbers and sums: "1/s" is a unit, "10", "-m" and "m + 1" are not.
bool looksLikeUnit(const std::string& text) {
  const bool reciprocal = text.compare(0, 2, "1/") == 0;
  const std::size_t begin = reciprocal ? 2 : 0;
  return text.size() > begin && text.find_first_of("+@,;:()#'\"") == std::string::npos &&
         std::string("0123456789.-*/^ ").find(text[begin]) == std::string::npos;
}

}  // namespace

bool isUnit(const std::string& text) {
  return looksLikeUnit(text) && units().has(text);
}

double unitScale(const std::string& unit, const std::string& wanted) {
  return unit.empty() || unit == wanted ? 1.0 : units().scale(unit, wanted);
}

}  // namespace whirl_twin
