// Positive position feedback: a filter that swings with what is measured, near a resonance of it,
// and pushes with what it has seen, a quarter turn late, so that the resonance is damped without a
// rate being measured (J. L. Fanson, T. K. Caughey, AIAA Journal 28 (1990) 717):
//
//   e'' + 2 z w e' + w^2 e = w^2 y,   u = gain e
//
// in samples T apart by the semi-implicit Euler step, axis by axis:
//
//   r(k + 1) = r(k) + T (w^2 (y(k) - e(k)) - 2 z w r(k)),  e(k + 1) = e(k) + T r(k + 1),
//   u(k) = gain e(k)
//
// At rest it pushes with gain y: it takes `gain` off a stiffness, and nothing holds where that is
// more than there is.
#pragma once

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "control/transfer_function.h"
#include "controllers/controller_entry.h"

namespace position_feedback {

using namespace whirl_twin;

struct PositionFeedback {
  static constexpr const char* kName = "position_feedback";
  static constexpr const char* kSummary = "damps a resonance by a filter of what is measured";

  double gain = 0.0;           ///< [output/measured]
  double frequency = 0.0;      ///< [rad/s], w, of the filter
  double damping_ratio = 0.0;  ///< [-], z, of the filter

  static constexpr std::array<Parameter<PositionFeedback>, 3> parameters() {
    return {{{"gain", "output/measured", Range::kPositive, &PositionFeedback::gain,
              "of the filtered signal; taken off the stiffness at rest"},
             {"frequency", "rad/s", Range::kPositive, &PositionFeedback::frequency,
              "of the filter; a little above the resonance"},
             {"damping_ratio", "-", Range::kPositive, &PositionFeedback::damping_ratio,
              "of the filter", 0.3}}};
  }

  void prepare(const ControllerPlan& plan) {
    if (plan.measured != plan.outputs) {
      throw SetupError("gain", "acts axis by axis: as many must be measured as acted on");
    }
    if (frequency > plan.rate) {
      throw SetupError("frequency", "must be at most 1 rad/s for each Hz of the rate, " +
                                        std::to_string(plan.rate) + ", or the filter rings");
    }
    axes.resize(plan.outputs);
  }

  void reset(const ControllerPlan& plan) noexcept {
    period = 1.0 / plan.rate;
    std::fill(axes.begin(), axes.end(), Axis{});
  }

  void update(const ControlSample& sample, double* outputs) noexcept {
    for (std::size_t i = 0; i < axes.size(); ++i) {
      Axis& axis = axes[i];
      outputs[i] = gain * axis.value;
      axis.rate += period * (frequency * frequency * (sample.values[i] - axis.value) -
                             2.0 * damping_ratio * frequency * axis.rate);
      axis.value += period * axis.rate;
    }
  }

  /// The filter goes on with what it has seen.
  void takeOver(const PositionFeedback& before) noexcept { axes = before.axes; }

  /// States, of each axis: e, then r.
  DiscreteStateSpace linear(double) const {
    const double push = period * frequency * frequency;
    const double kept = 1.0 - 2.0 * period * damping_ratio * frequency;
    DiscreteStateSpace law;
    law.a = (Eigen::MatrixXd(2, 2) << 1.0 - period * push, period * kept, -push, kept).finished();
    law.b = (Eigen::MatrixXd(2, 1) << period * push, push).finished();
    law.c = (Eigen::MatrixXd(1, 2) << gain, 0.0).finished();
    law.d = Eigen::MatrixXd::Zero(1, 1);
    return onEachAxis(law, static_cast<Eigen::Index>(axes.size()));
  }

  struct Axis {
    double value = 0.0;  ///< e
    double rate = 0.0;   ///< r
  };
  std::vector<Axis> axes;
  double period = 0.0;  ///< [s]
};

}  // namespace position_feedback
