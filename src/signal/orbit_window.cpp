#include "signal/orbit_window.h"

#include <algorithm>
#include <cmath>

#include "algebra/constants.h"

namespace whirl_twin {

namespace {

constexpr std::size_t kMaxWindowSamples = 4096;  // samples kept, before the oldest quarter goes
constexpr double kSamplesPerTurn = 64.0;         // kept at least, where there are so many
constexpr double kMaxPeriod = 5.0e-3;            // [s], for a whirl that is faster than the shaft
/// Of indices: with corrupt counters or time stamps a sample seems to take no time.
constexpr std::int64_t kWidest = std::int64_t{1} << 40;

/// Of the highest speed in a window, below which its turns are not alike: what an unbalance does
/// goes by the square of the speed.
constexpr double kSlowest = 0.5;

bool isFinite(const OrbitSample& s) {
  return std::isfinite(s.time) && std::isfinite(s.remainder) && std::isfinite(s.speed) &&
         std::isfinite(s.x) && std::isfinite(s.y);
}

double turned(const OrbitSample& from, const OrbitSample& to) {
  return static_cast<double>(to.turns - from.turns) + (to.remainder - from.remainder) / kTwoPi;
}

}  // namespace

void OrbitWindow::clear() {
  kept_.clear();
  stride_ = 1;
  sampling_ = 0.0;
}

void OrbitWindow::take(const OrbitSample& sample) {
  if (!isFinite(sample)) {
    return;
  }
  if (!kept_.empty() && sample.index == last_) {
    return;
  }
  if (!kept_.empty() && (sample.index < last_ || sample.time <= last_time_)) {
    clear();
  }
  if (!kept_.empty()) {
    sampling_ = (sample.time - last_time_) / static_cast<double>(sample.index - last_);
    const double wanted =
        std::min(kTwoPi / (kSamplesPerTurn * std::fabs(sample.speed)), kMaxPeriod);
    while (stride_ > 1 && static_cast<double>(stride_) * sampling_ > wanted) {
      stride_ /= 2;
    }
    while (stride_ < kWidest && 2.0 * static_cast<double>(stride_) * sampling_ <= 0.8 * wanted) {
      stride_ *= 2;
    }
  }
  last_ = sample.index;
  last_time_ = sample.time;
  if (kept_.capacity() < kMaxWindowSamples) {
    // Allocated and written once: memory that is first touched during a run looks like a leak for a
    // minute, and stepwise growth fragments the heap by the same amount.
    kept_.resize(kMaxWindowSamples);
    kept_.clear();
  }
  if (kept_.empty() || sample.index % stride_ == 0) {
    if (kept_.size() == kMaxWindowSamples) {
      kept_.erase(kept_.begin(), kept_.begin() + kMaxWindowSamples / 4);
    }
    kept_.push_back({sample, stride_});
  }
}

double OrbitWindow::since(double turns) const {
  if (kept_.empty()) {
    return 0.0;
  }
  const OrbitSample& now = kept_.back();
  const double direction = now.speed < 0.0 ? -1.0 : 1.0;
  // Bisection: the angle is monotonic unless the shaft reverses, which is checked afterwards.
  const auto far = [&](const OrbitSample& s) { return direction * turned(s, now) >= turns; };
  const auto first_near = std::partition_point(kept_.begin(), kept_.end(), far);
  if (first_near == kept_.begin()) {
    return 0.0;
  }
  const auto from = std::prev(first_near);
  const auto [slowest, fastest] =
      std::minmax_element(from, kept_.end(), [&](const OrbitSample& a, const OrbitSample& b) {
        return direction * a.speed < direction * b.speed;
      });
  const bool alike = direction * slowest->speed > kSlowest * direction * fastest->speed;
  return alike ? now.time - from->time : 0.0;
}

std::size_t OrbitWindow::firstOf(double seconds) const {
  const double from = kept_.back().time - seconds * (1.0 + 1.0e-12);
  const auto first = std::partition_point(kept_.begin(), kept_.end(),
                                          [&](const OrbitSample& s) { return s.time < from; });
  return static_cast<std::size_t>(first - kept_.begin());
}

OrbitPart OrbitWindow::last(double seconds, std::size_t most) const {
  OrbitPart part;
  if (kept_.empty()) {
    return part;
  }
  const std::size_t first = firstOf(seconds);
  // Strides are powers of two, so that indices of the widest are kept everywhere.
  std::int64_t stride = 1;
  for (std::size_t i = first; i < kept_.size(); ++i) {
    stride = std::max(stride, kept_[i].stride);
  }
  const std::int64_t span = kept_.back().index - kept_[first].index;
  while (static_cast<std::size_t>(span / stride) >= most) {
    stride *= 2;
  }
  std::vector<const OrbitSample*> taken;
  for (std::size_t i = first; i < kept_.size(); ++i) {
    if (kept_[i].index % stride == 0) {
      taken.push_back(&kept_[i]);
    }
  }
  if (taken.size() < 2) {
    return part;
  }
  const auto n = static_cast<Eigen::Index>(taken.size());
  const OrbitSample& from = *taken.front();
  part.centre = 0.5 * (from.time + taken.back()->time);
  part.half = 0.5 * (taken.back()->time - from.time);
  part.turns = from.turns;
  part.period = static_cast<double>(stride) * sampling_;
  part.tau.resize(n);
  part.angle.resize(n);
  part.x.resize(n);
  part.y.resize(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const OrbitSample& s = *taken[static_cast<std::size_t>(i)];
    part.tau[i] = (s.time - part.centre) / part.half;
    part.angle[i] = static_cast<double>(s.turns - from.turns) * kTwoPi + s.remainder;
    part.x[i] = s.x;
    part.y[i] = s.y;
    part.place.push_back((s.index - from.index) / stride);
  }
  const auto after = std::partition_point(
      taken.begin(), taken.end(), [&](const OrbitSample* s) { return s->time < part.centre; });
  const OrbitSample& right = **after;
  const OrbitSample& left = **std::prev(after);
  part.speed = left.speed +
               (right.speed - left.speed) * (part.centre - left.time) / (right.time - left.time);
  return part;
}

OrbitWindow::Box OrbitWindow::boxFrom(std::size_t first) const {
  const Kept& newest = kept_.back();
  Box box{newest.x, newest.x, newest.y, newest.y};
  for (std::size_t i = first; i < kept_.size(); ++i) {
    box.left = std::min(box.left, kept_[i].x);
    box.right = std::max(box.right, kept_[i].x);
    box.bottom = std::min(box.bottom, kept_[i].y);
    box.top = std::max(box.top, kept_[i].y);
  }
  return box;
}

double OrbitWindow::peakToPeak(double seconds) const {
  if (kept_.empty()) {
    return 0.0;
  }
  const Box box = boxFrom(firstOf(seconds));
  return std::max(box.right - box.left, box.top - box.bottom);
}

double OrbitWindow::amplitude(double seconds, std::size_t least) const {
  if (kept_.size() < least || kept_.empty()) {
    return kNaN;
  }
  const std::size_t first = std::min(firstOf(seconds), kept_.size() - least);
  const Box box = boxFrom(first);
  const double x = 0.5 * (box.left + box.right);
  const double y = 0.5 * (box.bottom + box.top);
  double largest = 0.0;
  for (std::size_t i = first; i < kept_.size(); ++i) {
    largest = std::max(largest, std::hypot(kept_[i].x - x, kept_[i].y - y));
  }
  return largest;
}

}  // namespace whirl_twin
