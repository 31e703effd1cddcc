#include "reports/ross_coupling.h"

#include <fmt/format.h>

#include <tuple>
#include <utility>

namespace whirl_twin {

RossCoupling rossCoupling(RossFile& file, const RossEntry& entry, int node) {
  RossCoupling coupling;
  coupling.row.emplace_back("element", std::to_string(node));
  for (const auto& [kind, ours, unit] :
       {std::tuple{"kt", "lateral_stiffness", "N/m"}, std::tuple{"kr", "bending_stiffness", "N m"},
        std::tuple{"ct", "lateral_damping", "N s/m"},
        std::tuple{"cr", "bending_damping", "N m s"}}) {
    const double along_x = file.number(entry, fmt::format("{}_x", kind).c_str(), unit, 0.0);
    coupling.row.emplace_back(ours, drawn(along_x));
    if (file.number(entry, fmt::format("{}_y", kind).c_str(), unit, 0.0) != along_x) {
      coupling.left_out.push_back(
          fmt::format("{0}: {1}_y differs from {1}_x, which is used", entry.key, kind));
    }
    if (file.number(entry, fmt::format("{}_z", kind).c_str(), unit, 0.0) != 0.0) {
      coupling.left_out.push_back(
          fmt::format("{}: {}_z, along or about the shaft", entry.key, kind));
    }
  }
  for (const auto& [end, at] : {std::pair{"l", node}, std::pair{"r", node + 1}}) {
    const auto of = [&file, &entry, side = end](const char* name, const char* unit) {
      return file.number(entry, fmt::format("{}_{}", name, side).c_str(), unit, 0.0);
    };
    const double polar = of("Ip", "kg m^2");
    const double across = of("Id", "kg m^2");
    coupling.hubs.push_back({{"node", std::to_string(at)},
                             {"mass", drawn(of("m", "kg"))},
                             {"polar_inertia", drawn(polar)},
                             {"transverse_inertia", drawn(across != 0.0 ? across : 0.5 * polar)}});
  }
  return coupling;
}

}  // namespace whirl_twin
