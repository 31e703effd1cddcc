// A filter that looks at its start again. One that begins with little, 10 % of a length or half of
// a damping, learns from derivatives that are wrong by as much, and is soon too sure. So it keeps
// what it was told since it began, and goes through all of it once more with the derivatives of
// where it has come to, until they stay the same (the iterated filter, B. M. Bell, SIAM J.
// Optimization 4 (1994): Gauss and Newton's method); then again when it has been told twice as
// much, until it knows its parameters well or has kept enough. What it began with is used once,
// whatever the number of looks.
//
// A look goes on beside the filter, some calls at each that comes, and takes its place when it has
// come as far: no sample waits for it. Of a linear rotor the first look was measured to be the
// better one: its unbalance is found over the whole of a run-up, of which a start is what tells
// least.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "estimation/system_filter.h"

namespace whirl_twin {

class StartingFilter final : public SystemFilter {
 public:
  using SystemFilter::SystemFilter;

  // As those of the filter.
  void begin(const ShaftInstant& at, std::int64_t to_twin = 0, double shaft_deviation = 0.0);
  void goTo(const ShaftInstant& there, double shaft_deviation = 0.0);
  Innovation take(std::size_t channel, double value, double deviation = 0.0);
  void takeInput(std::size_t channel, const InputSample& sample);
  void forgetMotion();
  void startOver();

  bool looksAtItsStart() const { return begun_ != nullptr; }

 private:
  struct Told {
    enum class Kind { kBegin, kGoTo, kTake, kInput, kForget } kind = Kind::kGoTo;
    ShaftInstant shaft{};
    std::int64_t to_twin = 0;
    std::size_t channel = 0;
    double value = 0.0;
    double deviation = 0.0;  // of a value, or of the shaft's angle
    std::int64_t time = 0;   // of an input's sample
  };

  void keep(const Told& told);
  bool isDue() const;
  bool stays(const SystemFilter& filter, double part) const;
  void beginLook();
  void endLook();
  void endStart();
  void tell(const Told& told);

  std::shared_ptr<const SystemFilter> begun_;  // as it was; none where nothing is kept
  std::int64_t start_ = 0;                     // [ns]
  std::vector<Told> told_;
  std::size_t next_look_ = 0;  // calls that have to be kept for it
  bool looked_ = false;
  std::optional<SystemFilter> look_;
  Eigen::VectorXd looked_at_;            // numbers whose derivatives the look takes
  std::size_t seen_ = 0;                 // calls, by the look
  std::size_t taken_ = 0, refused_ = 0;  // samples, by the look
};

}  // namespace whirl_twin
