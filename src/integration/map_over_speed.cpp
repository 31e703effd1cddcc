#include "integration/map_over_speed.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "algebra/constants.h"
#include "messages/refusal.h"

namespace whirl_twin {

namespace {

constexpr std::array<std::size_t, 2> kNodes{8, 16};
constexpr std::array<double, 2> kBetween{0.0, 0.92};  // of -1 ... 1: no nodes of either
constexpr double kNarrowest = 1.0e-6;                 // of the speed

double node(std::size_t i, std::size_t count) {
  return std::cos((2.0 * static_cast<double>(i) + 1.0) * kPi / (2.0 * static_cast<double>(count)));
}

}  // namespace

/// By the barycentric formula.
Eigen::MatrixXd MapOverSpeed::Part::at(double speed) const {
  const double x = (2.0 * speed - low - high) / (high - low);
  const std::size_t count = values.size();
  std::vector<double> shares(count);
  double sum = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    const double apart = x - node(i, count);
    if (apart == 0.0) {
      return values[i];
    }
    const double angle =
        (2.0 * static_cast<double>(i) + 1.0) * kPi / (2.0 * static_cast<double>(count));
    shares[i] = (i % 2 == 0 ? 1.0 : -1.0) * std::sin(angle) / apart;
    sum += shares[i];
  }
  Eigen::MatrixXd value = shares[0] / sum * values[0];
  for (std::size_t i = 1; i < count; ++i) {
    value += shares[i] / sum * values[i];
  }
  return value;
}

MapOverSpeed::MapOverSpeed(const Sample& sample, double low, double high, const Size& size,
                           double tolerance, double rounding) {
  add(sample, low, high, size, tolerance, rounding, kInfinity);
}

void MapOverSpeed::add(const Sample& sample, double low, double high, const Size& size,
                       double tolerance, double rounding, double before) {
  double error = 0.0;
  for (const std::size_t count : kNodes) {
    Part part{low, high, {}};
    for (std::size_t i = 0; i < count; ++i) {
      part.values.push_back(sample(0.5 * (low + high) + 0.5 * (high - low) * node(i, count)));
    }
    error = 0.0;
    for (const double x : kBetween) {
      const double speed = 0.5 * (low + high) + 0.5 * x * (high - low);
      const Eigen::MatrixXd exact = sample(speed);
      error = std::max(error, size(part.at(speed) - exact, exact));
    }
    // What no longer falls is the rounding of a very stiff rotor's map.
    const bool at_rounding = count == kNodes.back() && error < rounding && error > 0.5 * before;
    if (error <= tolerance || at_rounding) {
      parts_.push_back(std::move(part));
      return;
    }
  }
  const double middle = 0.5 * (low + high);
  if (!(high - low > kNarrowest * (1.0 + std::fabs(middle)))) {
    throw RunFailure(
        "the rotor's matrices change too fast with speed for its step: shorten the step");
  }
  add(sample, low, middle, size, tolerance, rounding, error);
  add(sample, middle, high, size, tolerance, rounding, error);
}

Eigen::MatrixXd MapOverSpeed::at(double speed) const {
  const auto part = std::find_if(parts_.begin(), parts_.end() - 1,
                                 [speed](const Part& p) { return speed <= p.high; });
  return part->at(speed);
}

}  // namespace whirl_twin
