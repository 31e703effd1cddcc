#include "controllers/external_link.h"

#include <algorithm>

namespace whirl_twin {

namespace {

constexpr std::size_t kCapacity = 1024;  // samples, or commands, that wait

}  // namespace

ExternalLink::ExternalLink(std::size_t measured, std::size_t outputs)
    : told_(kValues + measured, kCapacity),
      heard_(kValues + outputs, kCapacity),
      telling_(told_.recordSize()),
      hearing_(heard_.recordSize()),
      taking_(told_.recordSize()),
      answering_(heard_.recordSize()) {}

void ExternalLink::tell(std::int64_t run, std::int64_t sample, double time,
                        const double* values) noexcept {
  telling_[kRun] = static_cast<double>(run);
  telling_[kSample] = static_cast<double>(sample);
  telling_[kTime] = time;
  std::copy_n(values, measured(), telling_.begin() + kValues);
  told_.push(telling_.data());
}

bool ExternalLink::pop(RecordRing& ring, std::vector<double>& record,
                       ExternalSample& out) noexcept {
  if (!ring.pop(record.data())) {
    return false;
  }
  out.run = static_cast<std::int64_t>(record[kRun]);
  out.sample = static_cast<std::int64_t>(record[kSample]);
  out.time = record[kTime];
  std::copy(record.begin() + kValues, record.end(), out.values.begin());
  return true;
}

bool ExternalLink::hear(ExternalSample& command) noexcept {
  return pop(heard_, hearing_, command);
}

bool ExternalLink::take(ExternalSample& sample) {
  sample.values.resize(measured());
  return pop(told_, taking_, sample);
}

bool ExternalLink::answer(const ExternalSample& command) {
  constexpr std::int64_t kMost = std::int64_t{1} << 53;  // whole numbers in a double
  if (command.values.size() != outputs() || command.sample > kMost || command.sample < -kMost ||
      command.run > kMost || command.run < 0) {
    return false;
  }
  answering_[kRun] = static_cast<double>(command.run);
  answering_[kSample] = static_cast<double>(command.sample);
  answering_[kTime] = command.time;
  std::copy(command.values.begin(), command.values.end(), answering_.begin() + kValues);
  return heard_.push(answering_.data());
}

}  // namespace whirl_twin
