// A block of measured samples: of displacement probes, encoders, torque sensors, or the pulses of a
// keyphasor, each of which is an event with its own time stamp (one channel, `keyphasor`).
#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "messages/states.h"

namespace whirl_twin::state {

struct Measurement {
  static constexpr MessageKind kKind{"measurement", "Measurement", "measured/*",
                                     MessageKind::kSeries};
  /// Maximum number of values in a block: with instants and validity they fit the longest payload
  /// accepted in logs.
  static constexpr std::int64_t kMaxValues = 50'000;
  static constexpr std::int64_t kMaxChannels = 1'000;
  static constexpr std::int64_t kMaxPeriod = 3'600'000'000'000;  ///< [ns]

  Instant at;                         ///< step: number of the block; time: when it was completed
  std::string source;                 ///< name of the data source
  std::vector<std::string> channel;   ///< names
  std::vector<std::string> unit;      ///< of each channel
  std::vector<double> deviation;      ///< standard deviation of each, in its unit; NaN: unknown
  std::int64_t samples = 0;           ///< of each channel
  std::int64_t first_instant = 0;     ///< [ns], of the first sample
  std::int64_t period = 0;            ///< [ns], from sample to sample; 0: each has an instant
  std::vector<std::int64_t> instant;  ///< [ns], of each sample; none with a period
  std::vector<double> value;          ///< sample after sample, each with all channels
  std::vector<std::uint8_t> valid;    ///< of each value; 0: not to be used

  /// [ns], of a sample; of the last one.
  std::int64_t instantOf(std::int64_t sample) const {
    return period > 0 ? first_instant + sample * period : instant[static_cast<std::size_t>(sample)];
  }
  std::int64_t lastInstant() const { return instantOf(samples - 1); }

  template <class Visit>
  static void fields(Visit& visit) {
    visit.head(TWIN_FIELD(source));
    visit.array(TWIN_FIELD(channels), TWIN_FIELD(channel), "", requireChannels, Stays::kSame);
    visit.along(TWIN_FIELD(channel), TWIN_FIELD(unit), "", each(requireText));
    visit.along(TWIN_FIELD(channel), TWIN_FIELD(deviation), "", each(requireDeviation));
    visit(TWIN_FIELD(samples), "", between(1, kMaxValues));
    visit(TWIN_FIELD(first_instant), "ns", between(-kMaxStamp, kMaxStamp));
    visit(TWIN_FIELD(period), "ns", between(0, kMaxPeriod));
    visit.array(TWIN_FIELD(instants), TWIN_FIELD(instant), "ns",
                [](const char* name, const auto& instants, const auto& message) {
                  requireInstants(name, instants, message.samples, message.first_instant,
                                  message.period);
                });
    visit.array(TWIN_FIELD(values), TWIN_FIELD(value), "",
                [](const char* name, const auto& values, const auto& message) {
                  const auto channels = static_cast<std::int64_t>(message.channel.size());
                  requireRange("samples times channels", message.samples * channels, 1, kMaxValues);
                  requireLength(name, values.size(), message.samples * channels);
                });
    visit.along(TWIN_FIELD(value), TWIN_FIELD(valid), "", each(requireFlag));
  }

 private:
  static void requireChannels(const char* field, const std::vector<std::string>& names) {
    requireRange(field, static_cast<std::int64_t>(names.size()), 1, kMaxChannels);
    each(requireName)(field, names);
    std::vector<std::string> sorted = names;
    std::sort(sorted.begin(), sorted.end());
    const auto twice = std::adjacent_find(sorted.begin(), sorted.end());
    if (twice != sorted.end()) {
      throw RejectedMessage(std::string(field) + ": " + *twice + " is a duplicate");
    }
  }

  static void requireDeviation(const char* field, double deviation) {
    if (deviation < 0.0) {
      throw RejectedMessage(std::string(field) + ": expected at least 0");
    }
  }

  /// A period, or as many instants as samples, of which each is later than the one before.
  static void requireInstants(const char* field, const std::vector<std::int64_t>& instants,
                              std::int64_t samples, std::int64_t first, std::int64_t period) {
    if (period > 0) {
      requireLength(field, instants.size(), 0);
      return;
    }
    requireLength(field, instants.size(), samples);
    requireRange(field, instants.front(), first, first);
    requireRange(field, instants.back(), first, kMaxStamp);
    if (std::adjacent_find(instants.begin(), instants.end(), std::greater_equal<>()) !=
        instants.end()) {
      throw RejectedMessage(std::string(field) + ": expected increasing times");
    }
  }
};

}  // namespace whirl_twin::state
