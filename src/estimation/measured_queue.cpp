#include "estimation/measured_queue.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace whirl_twin {

namespace {

constexpr std::int64_t kNever = std::numeric_limits<std::int64_t>::min();
/// Further ahead of all others, or so many messages behind its own: the clock has been set.
constexpr std::int64_t kJump = 60'000'000'000;  // ns
constexpr int kBehind = 3;

std::int64_t instantOf(const state::Measurement& message, std::int64_t sample) {
  return message.period > 0 ? message.first_instant + sample * message.period
                            : message.instant[static_cast<std::size_t>(sample)];
}

}  // namespace

MeasuredQueue::MeasuredQueue(double patience)
    : patience_(std::llround(patience * 1.0e9)), given_(kNever) {}

std::size_t MeasuredQueue::addSource(const std::string& name, std::vector<std::string> channels) {
  Source source;
  source.name = name;
  source.channels = std::move(channels);
  sources_.push_back(std::move(source));
  return sources_.size() - 1;
}

bool MeasuredQueue::take(const state::Measurement& message) {
  const auto found = std::find_if(sources_.begin(), sources_.end(),
                                  [&](const Source& s) { return s.name == message.source; });
  if (found == sources_.end()) {
    return true;
  }
  Source& source = *found;
  const std::int64_t first = instantOf(message, 0);
  const std::int64_t last = lastInstant(message);
  const bool late = last <= std::max(given_, source.newest.value_or(kNever));
  const bool again = source.newest && message.at.step == source.newest_block;
  source.behind = late && !again ? source.behind + 1 : 0;
  const bool ahead = newest() != kNever && first > newest() && first - newest() > kJump;
  const bool set = ahead || source.behind >= kBehind;
  if (set) {
    for (Source& other : sources_) {
      other.waiting.clear();
      other.newest.reset();
      other.behind = 0;
    }
    given_ = kNever;
  }
  takeSamples(message, source, static_cast<std::size_t>(found - sources_.begin()));
  return !set;
}

void MeasuredQueue::takeSamples(const state::Measurement& message, Source& source,
                                std::size_t number) {
  if (source.newest && message.at.step > source.newest_block + 1) {
    source.counts.lost += (message.at.step - source.newest_block - 1) * source.block_size;
  }
  std::vector<std::size_t> place;  // of each of its channels in the message
  for (const std::string& channel : source.channels) {
    place.push_back(static_cast<std::size_t>(
        std::find(message.channel.begin(), message.channel.end(), channel) -
        message.channel.begin()));
  }
  for (std::int64_t k = 0; k < message.samples; ++k) {
    const std::int64_t time = instantOf(message, k);
    if (source.newest && time <= *source.newest) {
      ++source.counts.repeated;
      continue;
    }
    if (time <= given_) {
      ++source.counts.late;
      continue;
    }
    for (std::size_t c = 0; c < place.size(); ++c) {
      if (place[c] < message.channel.size()) {
        const std::size_t at = static_cast<std::size_t>(k) * message.channel.size() + place[c];
        source.waiting.push_back({time, number, c, message.value[at],
                                  message.valid[at] != 0 && std::isfinite(message.value[at])});
      }
    }
    source.newest = time;
  }
  source.newest_block = message.at.step;
  source.block_size = message.samples;
}

std::int64_t MeasuredQueue::newest() const {
  std::int64_t newest = kNever;
  for (const Source& source : sources_) {
    newest = std::max(newest, source.newest.value_or(kNever));
  }
  return newest;
}

bool MeasuredQueue::silent(std::size_t source) const {
  const std::int64_t latest = newest();
  return latest != kNever &&
         (!sources_[source].newest || latest - *sources_[source].newest > patience_);
}

std::int64_t MeasuredQueue::completeUntil() const {
  const std::int64_t latest = newest();
  if (latest == kNever || finished_) {
    return latest;
  }
  std::int64_t until = latest;
  for (const Source& source : sources_) {
    until = std::min(until, std::max(source.newest.value_or(kNever), latest - patience_));
  }
  return until;
}

std::optional<MeasuredSample> MeasuredQueue::next() {
  Source* first = nullptr;
  for (Source& source : sources_) {
    if (!source.waiting.empty() &&
        (first == nullptr || source.waiting.front().time < first->waiting.front().time)) {
      first = &source;
    }
  }
  if (first == nullptr || first->waiting.front().time > completeUntil()) {
    return std::nullopt;
  }
  const MeasuredSample sample = first->waiting.front();
  first->waiting.pop_front();
  given_ = std::max(given_, sample.time);
  return sample;
}

const MeasuredSample* MeasuredQueue::front(std::size_t source) const {
  return sources_[source].waiting.empty() ? nullptr : &sources_[source].waiting.front();
}

}  // namespace whirl_twin
