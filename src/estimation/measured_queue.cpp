#include "estimation/measured_queue.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "messages/units.h"

namespace whirl_twin {

namespace {

constexpr std::int64_t kNever = std::numeric_limits<std::int64_t>::min();
/// Consecutive late messages of a source after which its clock is assumed to have been set.
constexpr int kBehind = 3;

}  // namespace

MeasuredQueue::MeasuredQueue(double patience)
    : patience_(std::llround(patience * 1.0e9)), given_(kNever) {}

std::size_t MeasuredQueue::addSource(const std::string& name, std::vector<std::string> channels,
                                     std::vector<std::string> units) {
  Source source;
  source.name = name;
  source.channels = std::move(channels);
  source.units = std::move(units);
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
  const std::int64_t first = message.instantOf(0);
  const std::int64_t last = message.lastInstant();
  const bool late = last <= std::max(given_, source.newest.value_or(kNever));
  const bool again = source.newest && message.at.step == source.newest_block;
  source.behind = late && !again ? source.behind + 1 : 0;
  const bool ahead = newest() != kNever && first > newest() && first - newest() > kClockJump;
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
  struct Column {
    std::size_t place;        // in the message; beyond its channels: missing
    double scale, deviation;  // 0: not usable; 0: not specified
  };
  std::vector<Column> columns;
  for (std::size_t c = 0; c < source.channels.size(); ++c) {
    Column column{static_cast<std::size_t>(std::find(message.channel.begin(), message.channel.end(),
                                                     source.channels[c]) -
                                           message.channel.begin()),
                  0.0, 0.0};
    if (column.place < message.channel.size()) {
      column.scale =
          source.units[c].empty() ? 1.0 : unitScale(message.unit[column.place], source.units[c]);
      const double said = column.scale * message.deviation[column.place];
      column.deviation = std::isfinite(said) ? said : 0.0;
    }
    columns.push_back(column);
  }
  for (std::int64_t k = 0; k < message.samples; ++k) {
    const std::int64_t time = message.instantOf(k);
    if (source.newest && time <= *source.newest) {
      ++source.counts.repeated;
      continue;
    }
    if (time <= given_) {
      ++source.counts.late;
      continue;
    }
    for (std::size_t c = 0; c < columns.size(); ++c) {
      const Column& column = columns[c];
      if (column.place < message.channel.size()) {
        const std::size_t at = static_cast<std::size_t>(k) * message.channel.size() + column.place;
        const double value = column.scale * message.value[at];
        source.waiting.push_back(
            {time, number, c, value, column.deviation,
             message.valid[at] != 0 && column.scale != 0.0 && std::isfinite(value)});
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

const MeasuredSample* MeasuredQueue::front(std::size_t source, std::size_t channel) const {
  const auto& waiting = sources_[source].waiting;
  const auto found =
      std::find_if(waiting.begin(), waiting.end(),
                   [&](const MeasuredSample& sample) { return sample.channel == channel; });
  return found == waiting.end() ? nullptr : &*found;
}

}  // namespace whirl_twin
