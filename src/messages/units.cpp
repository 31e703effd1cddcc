#include "messages/units.h"

#include <algorithm>
#include <array>

namespace whirl_twin {

namespace {

constexpr double kDegree = 0.017453292519943295;  // rad

struct Unit {
  const char* name;
  const char* base;
  double scale;  // of the base
};

constexpr std::array<Unit, 10> kUnits = {{{"m", "m", 1.0},
                                          {"mm", "m", 1.0e-3},
                                          {"um", "m", 1.0e-6},
                                          {"rad", "rad", 1.0},
                                          {"mrad", "rad", 1.0e-3},
                                          {"deg", "rad", kDegree},
                                          {"N", "N", 1.0},
                                          {"kN", "N", 1.0e3},
                                          {"N m", "N m", 1.0},
                                          {"mN m", "N m", 1.0e-3}}};

const Unit* find(const std::string& name) {
  const auto* const found =
      std::find_if(kUnits.begin(), kUnits.end(), [&](const Unit& u) { return name == u.name; });
  return found == kUnits.end() ? nullptr : found;
}

bool isRate(const std::string& unit) {
  return unit.size() > 2 && unit.compare(unit.size() - 2, 2, "/s") == 0;
}

}  // namespace

double unitScale(const std::string& unit, const std::string& wanted) {
  if (unit.empty() || unit == wanted) {
    return 1.0;
  }
  if (isRate(unit) != isRate(wanted)) {
    return 0.0;
  }
  const std::size_t rate = isRate(unit) ? 2 : 0;
  const Unit* const from = find(unit.substr(0, unit.size() - rate));
  const Unit* const to = find(wanted.substr(0, wanted.size() - rate));
  const bool alike =
      from != nullptr && to != nullptr && std::string(from->base) == std::string(to->base);
  return alike ? from->scale / to->scale : 0.0;
}

}  // namespace whirl_twin
