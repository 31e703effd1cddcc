// Extended Kalman filter with an iterated initialization. With a poor initial estimate (10 % of a
// length, half of a damping) the first linearizations are wrong by as much, and the filter soon is
// overconfident. Therefore it stores the measurements since its start and repeats the filtering of
// all of them, linearized at the latest estimate, until the linearization point no longer changes
// (iterated filter, B. M. Bell, SIAM J. Optimization 4 (1994): Gauss-Newton method); then again
// after twice as many measurements, until the parameters are known well or the storage is full. The
// prior is used once, whatever the number of passes.
//
// A pass runs beside the filter, some stored calls for each new one, and replaces its estimate when
// it has caught up: no sample waits for it. Linear systems have no passes: for a rotor's unbalance,
// which is estimated over a whole run-up, they proved worse, since its start contains little
// information.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "estimation/extended_kalman_filter.h"

namespace whirl_twin {

class IteratedInitializer final : public ExtendedKalmanFilter {
 public:
  using ExtendedKalmanFilter::ExtendedKalmanFilter;

  // As in the base class.
  void begin(const ShaftInstant& at, std::int64_t to_twin = 0, double shaft_deviation = 0.0);
  void goTo(const ShaftInstant& there, double shaft_deviation = 0.0);
  Innovation take(std::size_t channel, double value, double deviation = 0.0);
  void takeInput(std::size_t channel, const InputSample& sample);
  void forgetMotion();
  void startOver();

  bool looksAtItsStart() const { return begun_ != nullptr; }

 private:
  struct StoredStep {
    enum class Kind { kBegin, kGoTo, kTake, kInput, kForget } kind = Kind::kGoTo;
    ShaftInstant shaft{};
    std::int64_t to_twin = 0;
    std::size_t channel = 0;
    double value = 0.0;
    double deviation = 0.0;  // of a value, or of the shaft's angle
    std::int64_t time = 0;   // of an input's sample
  };

  void keep(const StoredStep& stored);
  bool isDue() const;
  bool stays(const ExtendedKalmanFilter& filter, double part) const;
  void beginLook();
  void endLook();
  void endStart();
  void replay(const StoredStep& stored);

  std::shared_ptr<const ExtendedKalmanFilter> begun_;  // filter at its start; null: not storing
  std::int64_t start_ = 0;                             // [ns]
  std::vector<StoredStep> stored_;
  std::size_t next_look_ = 0;  // number of stored calls before the next pass
  bool looked_ = false;
  std::optional<ExtendedKalmanFilter> look_;
  Eigen::VectorXd looked_at_;            // linearization point of the pass
  std::size_t seen_ = 0;                 // calls processed by the pass
  std::size_t taken_ = 0, refused_ = 0;  // samples of the pass
};

}  // namespace whirl_twin
