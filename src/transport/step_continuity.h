// Whether the states of one channel follow one another without a hole. A channel sends every step,
// or every n-th: the stride is the difference that occurs most. A gap is a difference of two
// strides or more.
#pragma once

#include <cstdint>
#include <map>

namespace whirl_twin {

class StepContinuity {
 public:
  /// Takes note of the next state's step (>= 0).
  void add(std::int64_t step);

  /// Steps from one state to the next; 0 with fewer than two states.
  std::int64_t stride() const;
  /// Places where states are missing.
  std::uint64_t gaps() const;
  /// States missing in all gaps, as far as their lengths are known.
  std::uint64_t lost() const;
  /// States with the step of the one before.
  std::uint64_t repeated() const { return repeated_; }
  /// Steps smaller than the one before: a twin that was reset, or a damaged step.
  std::uint64_t backward() const { return backward_; }

 private:
  std::int64_t last_ = -1;
  std::map<std::int64_t, std::uint64_t> forward_;  ///< how often each difference > 0 occurred
  std::uint64_t scattered_ = 0;                    ///< differences too many to keep
  std::uint64_t repeated_ = 0;
  std::uint64_t backward_ = 0;
};

}  // namespace whirl_twin
