#include "reference.h"

#include <limits>

namespace whirl_twin::comparison {

double amplitude(const Reference& reference, const Output& output,
                 const std::vector<std::size_t>& positions) {
  double largest = 0.0;
  for (std::size_t sample = 0; sample < output.samples; ++sample) {
    for (const std::size_t i : positions) {
      largest = std::max(largest, std::abs(reference.coordinates[sample * output.coordinates + i]));
    }
  }
  return largest;
}

double relativeError(const ComparedScene& scene, const std::vector<double>& coordinates) {
  const std::vector<double>& truth = scene.reference.coordinates;
  double farthest = 0.0;
  double largest = 0.0;
  for (std::size_t sample = 0; sample < scene.output.samples; ++sample) {
    double difference = 0.0;
    double size = 0.0;
    for (const std::size_t position : scene.positions) {
      const std::size_t i = sample * scene.output.coordinates + position;
      difference += (coordinates[i] - truth[i]) * (coordinates[i] - truth[i]);
      size += truth[i] * truth[i];
    }
    if (!std::isfinite(difference)) {
      return std::numeric_limits<double>::infinity();
    }
    farthest = std::max(farthest, difference);
    largest = std::max(largest, size);
  }
  return std::sqrt(farthest / largest);
}

}  // namespace whirl_twin::comparison
