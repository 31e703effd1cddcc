#include "transport/logged_messages.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>

#include "messages/message_check.h"
#include "transport/bag_decode.h"
#include "transport/bag_scan.h"
#include "transport/event_scan.h"
#include "transport/lcm_decode.h"

namespace whirl_twin {

namespace {

bool isOneOf(const Kinds& kinds, const MessageKind* kind) {
  return std::find(kinds.begin(), kinds.end(), kind) != kinds.end();
}

/// Counts what has happened to a place of a file.
class Tally {
 public:
  Tally(LoggedMessages& log, const TakeLogged& take, const LogProgress& advanced)
      : log_(log), take_(take), advanced_(advanced) {}

  void pass(std::uint64_t offset) {
    if (++places_ % kMessagesPerProgress == 0) {
      advanced_(offset, log_.size);
    }
  }
  void damage(std::uint64_t offset, const std::string& what) {
    if (log_.damaged++ == 0) {
      log_.first_damage = fmt::format("byte {}: {}", offset, what);
    }
  }
  /// decode() may throw RejectedMessage.
  template <class Decode>
  void message(std::int64_t stamp, Decode&& decode) {
    try {
      take_(decode(), stamp);
      ++log_.taken;
    } catch (const RejectedMessage&) {
      ++log_.rejected;
    }
  }

 private:
  LoggedMessages& log_;
  const TakeLogged& take_;
  const LogProgress& advanced_;
  std::uint64_t places_ = 0;
};

LoggedMessages readLcmLog(const std::string& path, const std::string& prefix, const Kinds& kinds,
                          const TakeLogged& take, const LogProgress& advanced) {
  EventScan scan(path);
  LoggedMessages log;
  log.size = scan.size();
  Tally tally(log, take, advanced);
  RawEvent event;
  for (auto found = scan.next(event); found != EventScan::Found::kEnd; found = scan.next(event)) {
    tally.pass(scan.offset());
    if (found != EventScan::Found::kEvent) {
      tally.damage(scan.damageOffset(), scan.damage());
      continue;
    }
    const auto channel = parseChannel(event.channel, prefix);
    if (event.data != nullptr && channel && isOneOf(kinds, channel->kind)) {
      tally.message(event.timestamp,
                    [&] { return decodeEvent(event.channel, event.data, event.size, prefix); });
    }
  }
  return log;
}

LoggedMessages readBag(const std::string& path, const std::string& prefix, const Kinds& kinds,
                       const TakeLogged& take, const LogProgress& advanced) {
  BagScan scan(path);
  LoggedMessages log;
  log.size = scan.size();
  Tally tally(log, take, advanced);
  std::map<const BagConnection*, std::optional<BagDecoder>> decoders;
  BagMessage message;
  for (auto found = scan.next(message); found != BagScan::Found::kEnd; found = scan.next(message)) {
    tally.pass(scan.offset());
    if (found != BagScan::Found::kMessage) {
      tally.damage(scan.damageOffset(), scan.damage());
      continue;
    }
    const auto [place, is_new] = decoders.try_emplace(message.connection);
    std::optional<BagDecoder>& decoder = place->second;
    if (is_new) {
      try {
        decoder.emplace(*message.connection);
      } catch (const RejectedMessage&) {
        // None: its messages are rejected.
      }
      if (decoder && decoder->kind() != nullptr && decoder->prefix() != prefix &&
          !decoder->prefix().empty() && isOneOf(kinds, decoder->kind())) {
        log.elsewhere.insert(decoder->prefix());
      }
    }
    const bool wanted =
        !decoder ||
        (isOneOf(kinds, decoder->kind()) &&
         (decoder->prefix() == prefix || (decoder->isJointState() && decoder->prefix().empty())));
    if (wanted && message.data != nullptr) {
      tally.message(message.time / kMicrosecond, [&]() -> Message {
        if (!decoder) {
          throw RejectedMessage("a definition that cannot be read");
        }
        return decoder->decode(message);
      });
    }
  }
  return log;
}

}  // namespace

LoggedMessages readLoggedMessages(const std::string& path, const std::string& prefix,
                                  const Kinds& kinds, const TakeLogged& take,
                                  const LogProgress& advanced) {
  return (BagScan::isBag(path) ? readBag : readLcmLog)(path, prefix, kinds, take, advanced);
}

std::string foundElsewhere(const LoggedMessages& log) {
  std::string found = fmt::format("found none in {} bytes", log.size);
  if (!log.first_damage.empty()) {
    found += fmt::format(", of which {} place{} cannot be read, the first at {}", log.damaged,
                         log.damaged == 1 ? "" : "s", log.first_damage);
  }
  return log.elsewhere.empty()
             ? found
             : fmt::format("{}, but with {}", found, fmt::join(log.elsewhere, ", "));
}

}  // namespace whirl_twin
