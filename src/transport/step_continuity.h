// Whether the states of one channel follow one another without a hole. A channel sends every step,
// or every n-th: the stride is the difference that occurs most. A gap is a difference of two
// strides or more. Datagrams may overtake one another: a state that comes late, while at most
// kWindow that follow it have come, is put in its place.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>

namespace whirl_twin {

class StepContinuity {
 public:
  static constexpr std::size_t kWindow = 64;  ///< states that one may come after

  /// Takes note of the next state's step (>= 0).
  void add(std::int64_t step);

  /// Steps from one state to the next; 0 with fewer than two states.
  std::int64_t stride() const;
  /// Places where states are missing.
  std::uint64_t gaps() const;
  /// States missing in all gaps, as far as their lengths are known.
  std::uint64_t lost() const;
  /// States with the step of another.
  std::uint64_t repeated() const { return repeated_; }
  /// States that came after one that follows them; within the window they are in their place.
  std::uint64_t late() const { return late_; }
  /// How often the steps began anew from a smaller one: a twin that was reset.
  std::uint64_t backward() const { return backward_; }

 private:
  /// How often each difference > 0 occurred, between states in their order.
  struct Differences {
    std::map<std::int64_t, std::uint64_t> forward;
    std::uint64_t scattered = 0;  ///< differences too many to keep

    void count(std::int64_t from, std::int64_t to);
    std::int64_t stride() const;
  };

  void settle(std::size_t left);
  void beginAnew();
  Differences all() const;

  Differences differences_;          ///< up to last_
  std::int64_t last_ = -1;           ///< the last step that is settled
  std::deque<std::int64_t> window_;  ///< later steps, rising: others may come between
  std::int64_t before_ = -1;         ///< a step before the window that came just now
  std::uint64_t repeated_ = 0;
  std::uint64_t late_ = 0;
  std::uint64_t backward_ = 0;
};

}  // namespace whirl_twin
