#include "integration/stoermer_weights.h"

namespace whirl_twin {

DenseOutputWeights::DenseOutputWeights(const StoermerScheme& scheme, double at)
    : share(at), position{}, rate{}, work{} {
  double power = at;  // at^(i + 1)
  for (std::size_t i = 0; i < scheme.terms; ++i) {
    const auto above = static_cast<double>(i + 1);
    const double both = above * (above + 1.0);
    const double of_position = (power * at - at) / both;
    const double of_rate = power / above - 1.0 / both;
    const double of_work = (1.0 - power) / above;
    for (std::size_t k = 0; k < scheme.terms; ++k) {
      const double weight = scheme.polynomial[i][k];
      position[k] += weight * of_position;
      rate[k] += weight * of_rate;
      work[k] += weight * of_work;
    }
    power *= at;
  }
}

}  // namespace whirl_twin
