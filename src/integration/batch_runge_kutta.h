// Batch of systems of one model on one shaft, stepped by an explicit Runge-Kutta method, without
// energy audit.
//
// The operations and their order are the same for every system, independent of its index.
// Coordinates and rates are compensated sums, as for a single system (motion_state.h); the results
// differ from those of a single system by the rounding of the equations.
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "control/drive.h"
#include "mechanics/evaluation_point.h"
#include "realtime/state_image.h"

namespace whirl_twin {

// The equations of a batch of systems of one model, evaluated in SIMD vectors.

class BatchEquations {
 public:
  /// Systems per block; copies of the last system fill the last block.
  static constexpr std::size_t kBlock = 32;

  virtual ~BatchEquations() = default;
  virtual std::size_t count() const noexcept = 0;
  virtual std::size_t dof() const noexcept = 0;
  /// Does the motion of a shaft enter?
  virtual bool hasShaft() const noexcept = 0;
  /// Is a coordinate an angle?
  virtual bool angular(std::size_t coordinate) const noexcept = 0;

  /// q'' of the members of a block: q, v and a have kBlock numbers for each coordinate in turn.
  /// Real-time safe.
  virtual void accelerate(std::size_t block, const double* q, const double* v,
                          const EvaluationPoint<double>& at, double* a) const noexcept = 0;
};

/// An explicit Runge-Kutta method.
struct RungeKuttaTable {
  static constexpr std::size_t kMaxStages = 12;
  using Row = std::array<double, kMaxStages>;

  std::size_t stages;
  Row nodes;
  std::array<Row, kMaxStages> a;
  Row weights;
};

/// By its name in scenes; nullptr: it is none, or not for members side by side.
const RungeKuttaTable* rungeKuttaTable(const std::string& integrator);

class BatchRungeKutta {
 public:
  /// Steps of `step` [s] in `substeps` parts. The table outlives it.
  BatchRungeKutta(std::unique_ptr<BatchEquations> equations, const RungeKuttaTable& method,
                  double step, int substeps);

  const BatchEquations& equations() const noexcept { return *equations_; }
  std::size_t count() const noexcept { return equations_->count(); }
  std::size_t dof() const noexcept { return n_; }

  // Real-time safe.

  /// Sets the state of a system and discards its history.
  void set(std::size_t member, const double* q, const double* v) noexcept;
  void exchange(StateImage& image) noexcept { image(state_, stopped_); }
  /// One step from simulated time [s]; the drive is at its start.
  void step(const Drive& drive, double time) noexcept;

  /// It has no finite motion any more; its coordinates mean nothing.
  bool stopped(std::size_t member) const noexcept { return stopped_[member] != 0; }
  double q(std::size_t member, std::size_t i) const noexcept { return of(member, kQ, i); }
  double v(std::size_t member, std::size_t i) const noexcept { return of(member, kV, i); }
  /// The largest magnitude of a coordinate at the start and after any step since.
  double peak(std::size_t member, std::size_t i) const noexcept { return of(member, kPeak, i); }

 private:
  static constexpr std::size_t kBlock = BatchEquations::kBlock;
  /// Values stored per coordinate of each system.
  enum Kind : std::size_t { kQ, kV, kQLow, kVLow, kPeak, kKinds };

  /// The sums of a stage: from + h (factors . terms), of which there are `count`.
  struct Terms {
    std::size_t count = 0;
    std::array<double, RungeKuttaTable::kMaxStages> factor{};
    std::array<std::size_t, RungeKuttaTable::kMaxStages> stage{};
  };

  std::size_t blocks() const noexcept { return (count() + kBlock - 1) / kBlock; }
  std::size_t width() const noexcept { return n_ * kBlock; }
  double* block(std::size_t number) noexcept { return state_.data() + number * kKinds * width(); }
  double of(std::size_t member, Kind kind, std::size_t i) const noexcept {
    return state_[(member / kBlock) * kKinds * width() + kind * width() + i * kBlock +
                  member % kBlock];
  }
  void put(std::size_t number, std::size_t lane, const double* q, const double* v) noexcept;
  void advance(std::size_t number, const Drive& drive, double time, double offset,
               double h) noexcept;
  void methodStep(std::size_t number, const Drive& drive, double time, double offset,
                  double h) noexcept;
  void look(std::size_t number) noexcept;

  std::unique_ptr<BatchEquations> equations_;
  std::size_t n_;
  std::size_t stages_;
  std::array<double, RungeKuttaTable::kMaxStages> nodes_;
  std::array<Terms, RungeKuttaTable::kMaxStages + 1> terms_;  ///< the last: of the whole step
  double substep_;                                            ///< [s]
  int substeps_;
  std::vector<double> start_;           ///< q, v of each system
  std::vector<double> state_;           ///< of each block
  std::vector<unsigned char> stopped_;  ///< of each system
  // Of the block that is stepped.
  std::vector<double> rates_, accelerations_;  ///< at each stage
  std::vector<double> sum_;
};

}  // namespace whirl_twin
