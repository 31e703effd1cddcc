// Runs at the extremes: their length, and their printed results. By default they are shortened;
// with WHIRL_TWIN_EXTREMES=full in the environment (scripts/extremes sets it) they have their full
// length, up to a billion steps.
#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <vector>

#include "../models/every_variant.h"

namespace whirl_twin {

constexpr std::int64_t kMicrosecond = 1000;  // [ns]
constexpr std::int64_t kMillisecond = 1000 * kMicrosecond;
constexpr std::int64_t kSecond = 1000 * kMillisecond;

inline bool fullLength() {
  const char* length = std::getenv("WHIRL_TWIN_EXTREMES");
  return length != nullptr && std::string(length) == "full";
}

/// As many steps as this run is to have.
inline std::int64_t runOf(std::int64_t shortened, std::int64_t full) {
  return fullLength() ? full : shortened;
}

/// A value that must lie within its bound (NaN does not); it is printed.
inline void expectWithin(double bound, double value, const std::string& what) {
  fmt::print("[ MEASURED ] {}: {:.2e}, at most {:.2e}\n", what, value, bound);
  EXPECT_LE(value, bound) << what;
}

/// The methods for any motion that a model can step with, in its plain form.
inline std::vector<std::string> integratorsOf(const std::string& model) {
  return integratorsOf(findModel(model)->variants.front());
}

/// Order of a method's error; one not named here has at least the last.
inline int orderOf(const std::string& integrator) {
  return integrator == "semi_implicit_euler"                                    ? 1
         : integrator == "velocity_verlet" || integrator == "implicit_midpoint" ? 2
         : integrator == "runge_kutta_4" || integrator == "gauss_legendre_4"    ? 4
                                                                                : 6;
}

/// Maximum relative error of a method's numerical frequency, z = p h well below 1: z^2/24
/// (semi-implicit Euler, Verlet), z^2/12 (implicit midpoint), z^4/120 (Runge-Kutta 4), z^4/720
/// (Gauss-Legendre 4), z^6/100800 (Gauss-Legendre 6), 863 z^6/24192 (Stoermer 6: half of the first
/// term that its sum omits), less for those of a higher order.
inline double detuning(const std::string& integrator, double z) {
  const int order = orderOf(integrator);
  return order <= 2                   ? z * z / 12.0
         : integrator == "stoermer_6" ? std::pow(z, 6) / 28.0
                                      : std::pow(z, order) / (order == 4 ? 120.0 : 1e5);
}

/// A method that makes a step of the accelerations of those before, in sums.
inline bool hasPast(const std::string& integrator) {
  return integrator.rfind("stoermer", 0) == 0;
}

}  // namespace whirl_twin
