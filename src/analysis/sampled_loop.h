// A linear plant under controllers that sample it, each at its own rate and late by its own delay:
// what one common period makes of it, exactly.
//
// Between two instants every output is held, so that e^(A t) and its integral take the plant along
// without an error; at an instant a controller reads, or one of its outputs comes into force (K.
// Astrom, B. Wittenmark, Computer-Controlled Systems, 3rd ed., 1997, ch. 2-3). States are those of
// the plant, of the poles of sensors and actuators, of the laws, and the outputs that have been
// computed but have yet to act: tau = (d - 1) T + tau', 0 < tau' <= T, are d of them.
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
  double sensor_delay = 0.0;           ///< s: a sample shows what was so long ago
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
  /// In so many directions the loop stays where it is left, to 1e-13 of the terms that cancel
  /// there: eigenvalues 1 of the transition that rounding may have moved.
  int standing = 0;
};

/// Most samples of all controllers in a common period, and most states of a loop.
constexpr int kMostLoopSamples = 1000;
constexpr int kMostLoopStates = 4000;

/// Throws Refusal where a number cannot be meant (a rate <= 0, a delay < 0, no controller at all),
/// RunFailure where the rates have no common period of kMostLoopSamples or delays make more states
/// than kMostLoopStates; std::logic_error where shapes do not fit.
/// Not real-time safe (allocates).
SampledLoop sampledLoop(const LoopPlant& plant, const std::vector<LoopController>& controllers);

/// Where a loop is opened: at what a controller is shown of one of its measures, or at an output of
/// it, which is where the plant is acted on.
struct LoopPlace {
  std::size_t controller = 0;
  Eigen::Index channel = 0;  ///< of the controller's own `measures` or `acts_on`
  bool at_output = false;
};

/// The loop opened to numbers that are added at places, and to what is then found there. Columns of
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
