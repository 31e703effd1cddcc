// Detects gaps in the states of one channel. A channel sends every step, or every n-th: the stride
// is the most frequent difference. A gap is a difference of two strides or more. Datagrams may be
// reordered: a state that arrives after at most kWindow later ones is sorted into its place.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>

namespace whirl_twin {

class StepContinuity {
 public:
  static constexpr std::size_t kWindow = 64;  ///< reordering depth [states]

  /// Adds the step of the next state (>= 0).
  void add(std::int64_t step);

  /// The stride [steps]; 0 with fewer than two states.
  std::int64_t stride() const;
  /// Number of gaps.
  std::uint64_t gaps() const;
  /// States missing in all gaps whose lengths are known.
  std::uint64_t lost() const;
  /// States with the step of an earlier one (duplicates).
  std::uint64_t repeated() const { return repeated_; }
  /// States out of order; those within the window are sorted into their place.
  std::uint64_t late() const { return late_; }
  /// Number of restarts from a smaller step: resets of the twin.
  std::uint64_t backward() const { return backward_; }

 private:
  /// Number of occurrences of each difference > 0 between successive states.
  struct Differences {
    std::map<std::int64_t, std::uint64_t> forward;
    std::uint64_t scattered = 0;  ///< occurrences of differences that are not kept

    void count(std::int64_t from, std::int64_t to);
    std::int64_t stride() const;
  };

  void settle(std::size_t left);
  void beginAnew();
  Differences all() const;

  Differences differences_;          ///< up to last_
  std::int64_t last_ = -1;           ///< the last step evaluated
  std::deque<std::int64_t> window_;  ///< later steps, ascending: others may be inserted
  std::int64_t before_ = -1;         ///< the previous step, if older than the window; else -1
  std::uint64_t repeated_ = 0;
  std::uint64_t late_ = 0;
  std::uint64_t backward_ = 0;
};

}  // namespace whirl_twin
