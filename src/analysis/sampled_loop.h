// Exact transition over one common period of a linear plant with sampled controllers, each with its
// own rate and delay.
//
// Between two instants every output is constant (zero-order hold), so that e^(A t) and its integral
// advance the plant without error; at an instant a controller samples, or one of its outputs takes
// effect (K. Astrom, B. Wittenmark, Computer-Controlled Systems, 3rd ed., 1997, ch. 2-3). States
// are those of the plant, of the poles of sensors and actuators, of the control laws, and the
// outputs that have been computed but are still delayed: tau = (d - 1) T + tau', 0 < tau' <= T, are
// d of them.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "control/transfer_function.h"

namespace whirl_twin {

/// x' = a x + b u, y = c x, [1/s].
struct LoopPlant {
  Eigen::MatrixXd a;  ///< [n x n]
  Eigen::MatrixXd b;  ///< [n x inputs]
  Eigen::MatrixXd c;  ///< [measured x n]
};

struct LoopController {
  std::string name;
  double rate = 0.0;   ///< Hz: its k-th sample is at the whole nanosecond nearest to k / rate
  double delay = 0.0;  ///< s, from a sample to its outputs, which are held until the next come
  DiscreteStateSpace law;
  std::vector<Eigen::Index> measures;  ///< rows of the plant's c
  std::vector<Eigen::Index> acts_on;   ///< columns of the plant's b; outputs of several add up
  double sensor_bandwidth = 0.0;       ///< Hz, of a first-order pole before the sampler; 0: none
  double sensor_delay = 0.0;           ///< s: delay of a sample
  double actuator_bandwidth = 0.0;     ///< Hz, of a first-order pole after the hold; 0: none
};

struct SampledLoop {
  /// [n x n], of the states at one common sample (just before it) to those at the next: the plant's
  /// first, then poles of sensors and actuators and states of laws, outputs on their way, and
  /// outputs in force, each controller in turn.
  Eigen::MatrixXd transition;
  double period = 0.0;       ///< s, of all controllers; of one rate: of a sample
  std::vector<int> samples;  ///< of each controller in a period
  /// The instants are those of whole nanoseconds. Not so where the period is no whole number of
  /// them: then samples are k / rate apart, from which those of the running twin differ by 0.5 ns.
  bool whole_nanoseconds = false;
  /// Number of directions in which the loop is neutral, to 1e-13 of the terms that cancel there:
  /// eigenvalues 1 of the transition that rounding may have moved.
  int standing = 0;
};

/// Most samples of all controllers in a common period, and most states of a loop.
constexpr int kMaxLoopSamples = 1000;
constexpr int kMaxLoopStates = 4000;

/// Throws InputError for invalid numbers (a rate <= 0, a delay < 0, no controller at all),
/// RunFailure where the rates have no common period of kMaxLoopSamples or delays lead to more
/// states than kMaxLoopStates; std::logic_error for inconsistent matrix sizes. Not real-time safe
/// (allocates).
SampledLoop sampledLoop(const LoopPlant& plant, const std::vector<LoopController>& controllers);

/// The point where a loop is opened: at a measured signal of a controller, or at one of its outputs
/// (plant input).
struct LoopPlace {
  std::size_t controller = 0;
  Eigen::Index channel = 0;  ///< of the controller's own `measures` or `acts_on`
  bool at_output = false;
};

/// The loop opened at taps: from values added there to the values returned there. Columns of
/// `input` and rows of `output`: the samples in a period of the controller of each place in turn.
struct LoopTap {
  Eigen::MatrixXd input;   ///< [n x samples]
  Eigen::MatrixXd output;  ///< [samples x n]
  Eigen::MatrixXd
      direct;  ///< [samples x samples]; of one place lower triangular, 1 on the diagonal
};

/// Errors as sampledLoop().
LoopTap loopTap(const LoopPlant& plant, const std::vector<LoopController>& controllers,
                const std::vector<LoopPlace>& places);

}  // namespace whirl_twin
