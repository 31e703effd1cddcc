#include "realtime/timing_histogram.h"

#include <algorithm>
#include <cmath>

namespace whirl_twin {
namespace {

// Release and acquire on every field make FixedRateLoop's sequence count valid: a reader that saw
// any of the new values also sees the incremented count. On x86-64 they cost nothing.
template <class T>
T get(const std::atomic<T>& field) noexcept {
  return field.load(std::memory_order_acquire);
}

template <class T>
void set(std::atomic<T>& field, T value) noexcept {
  field.store(value, std::memory_order_release);
}

}  // namespace

TimingHistogram::TimingHistogram(const TimingHistogram& other) noexcept {
  *this = other;
}

TimingHistogram& TimingHistogram::operator=(const TimingHistogram& other) noexcept {
  for (std::size_t i = 0; i < buckets_.size(); ++i) {
    set(buckets_[i], get(other.buckets_[i]));
  }
  set(count_, get(other.count_));
  set(min_, get(other.min_));
  set(max_, get(other.max_));
  set(sum_, get(other.sum_));
  return *this;
}

void TimingHistogram::add(std::int64_t duration) noexcept {
  duration = std::max<std::int64_t>(duration, 0);
  std::atomic<std::uint64_t>& bucket = buckets_[bucketOf(duration)];
  // One writer, so a load and a store suffice where several would need an atomic addition.
  set(bucket, get(bucket) + 1);
  const std::uint64_t before = get(count_);
  if (before == 0 || duration < get(min_)) {
    set(min_, duration);
  }
  if (before == 0 || duration > get(max_)) {
    set(max_, duration);
  }
  set(sum_, get(sum_) + duration);
  set(count_, before + 1);
}

void TimingHistogram::reset() noexcept {
  for (std::atomic<std::uint64_t>& bucket : buckets_) {
    set(bucket, std::uint64_t{0});
  }
  set(count_, std::uint64_t{0});
  set(min_, std::int64_t{0});
  set(max_, std::int64_t{0});
  set(sum_, std::int64_t{0});
}

std::uint64_t TimingHistogram::count() const noexcept {
  return get(count_);
}

std::uint64_t TimingHistogram::overflow() const noexcept {
  return get(buckets_[kBuckets]);
}

std::int64_t TimingHistogram::min() const noexcept {
  return get(min_);
}

std::int64_t TimingHistogram::max() const noexcept {
  return get(max_);
}

double TimingHistogram::mean() const noexcept {
  const std::uint64_t samples = count();
  return samples == 0 ? 0.0 : static_cast<double>(get(sum_)) / static_cast<double>(samples);
}

std::int64_t TimingHistogram::percentile(double percent) const noexcept {
  const std::uint64_t samples = count();
  if (samples == 0) {
    return 0;
  }
  const double rank = std::ceil(std::clamp(percent, 0.0, 100.0) / 100.0 * samples);
  const std::uint64_t wanted = std::max<std::uint64_t>(1, static_cast<std::uint64_t>(rank));
  std::uint64_t below = 0;
  for (std::size_t i = 0; i < kBuckets; ++i) {
    below += get(buckets_[i]);
    if (below >= wanted) {
      return std::min(longestIn(i), max());
    }
  }
  return max();
}

// Durations of 0 to 2 kPerOctave - 1 are their own bucket numbers. Above, the duration is shifted
// into kPerOctave .. 2 kPerOctave - 1, which gives its position within its octave.
std::size_t TimingHistogram::bucketOf(std::int64_t duration) noexcept {
  if (duration >= kOverflow) {
    return kBuckets;
  }
  auto place = static_cast<std::uint64_t>(duration);
  std::size_t octave = 0;
  while (place >= 2 * kPerOctave) {
    place >>= 1;
    ++octave;
  }
  return octave * kPerOctave + static_cast<std::size_t>(place);
}

std::int64_t TimingHistogram::longestIn(std::size_t bucket) noexcept {
  const std::size_t octave = bucket < 2 * kPerOctave ? 0 : bucket / kPerOctave - 1;
  const std::size_t place = bucket - octave * kPerOctave;
  return static_cast<std::int64_t>((place + 1) << octave) - 1;
}

}  // namespace whirl_twin
