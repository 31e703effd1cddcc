// A system without an equilibrium has no motion whose stability could be judged: uncertain, and no
// alarm of stability. References: the load that nothing carries accelerates it; a machine that
// excites itself has an unstable equilibrium and is unstable wherever it swings.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "messages/alert.h"
#include "watched_twin.h"

namespace whirl_twin {
namespace no_equilibrium_test {

/// The verdict at the end, and whether UNSTABLE was raised.
struct Judged {
  std::string verdict;
  bool unstable = false;
};

Judged judged(const std::string& system) {
  WatchedTwin watched(sceneOf("{step: 0.001, systems: {one: " + system + "}}"));
  watched.run(0.5);
  Judged result{watched.margins.back().verdict_name};
  for (const state::Alert& event : watched.events) {
    result.unstable = result.unstable || event.type == alert_type::kUnstable;
  }
  return result;
}

// An engine whose load is more than its torque with the arms down stalls, whatever its governor
// does.
TEST(NoEquilibrium, AnEngineThatItsLoadStallsIsUncertain) {
  const auto engine = [](double load) {
    return judged(fmt::format(
        "{{model: governor, parameters: {{mass: 1.0, length: 0.25, inertia: 0.5, damping: 0.9, "
        "torque: 40.0, load: {}}}, initial: {{theta: 0.9, phi_rate: 8.0}}}}",
        load));
  };
  const Judged stalled = engine(60.0);
  EXPECT_EQ(stalled.verdict, "uncertain");
  EXPECT_FALSE(stalled.unstable);
  EXPECT_EQ(engine(20.0).verdict, "asymptotically_stable");
}

// Its bearings do not carry it along y.
TEST(NoEquilibrium, ARotorWhoseWeightNothingCarriesIsUncertain) {
  const auto rotor = [](double kyy) {
    return judged(fmt::format(
        "{{model: flexible_rotor, parameters: {{youngs_modulus: 2.1e+11, density: 7850, "
        "speed: 100, gravity_on_shaft: true, elements: [{{length: 0.1, outer_diameter: 0.05, "
        "count: 4}}], discs: [{{node: 2, mass: 15, polar_inertia: 0.1, transverse_inertia: "
        "0.06}}], bearings: [{{node: 0, kxx: 1e+7, kyy: {0}, cxx: 100, cyy: 100}}, "
        "{{node: 4, kxx: 1e+7, kyy: {0}, cxx: 100, cyy: 100}}]}}}}",
        kyy));
  };
  const Judged falls = rotor(0.0);
  EXPECT_EQ(falls.verdict, "uncertain");
  EXPECT_FALSE(falls.unstable);
  EXPECT_EQ(rotor(1.0e6).verdict, "asymptotically_stable");
}

}  // namespace no_equilibrium_test
}  // namespace whirl_twin
