#include "transport/logged_messages.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>

#include "messages/message_check.h"
#include "messages/names.h"
#include "transport/bag_decode.h"
#include "transport/bag_scan.h"
#include "transport/event_scan.h"
#include "transport/lcm_decode.h"
#include "transport/time_order.h"

namespace whirl_twin {

namespace {

bool isOneOf(const Kinds& kinds, const MessageKind* kind) {
  return std::find(kinds.begin(), kinds.end(), kind) != kinds.end();
}

/// Counts messages and defects of a file.
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
                          const TakeLogged& take, const LogProgress& advanced, LogOrder order) {
  const auto wanted = [&](const RawEvent& event) {
    const auto channel = parseChannel(event.channel, prefix);
    return event.data != nullptr && channel && isOneOf(kinds, channel->kind);
  };
  EventScan scan(path);
  LoggedMessages log;
  log.size = scan.size();
  Tally tally(log, take, advanced);
  TimeOrder<RawEvent> in_order(
      order == LogOrder::kOfFile ? 0 : largestDelay<EventScan, RawEvent>(path, wanted),
      [&](const RawEvent& event, std::uint64_t) {
        tally.message(event.timestamp,
                      [&] { return decodeEvent(event.channel, event.data, event.size, prefix); });
      });
  RawEvent event;
  for (auto found = scan.next(event); found != EventScan::Found::kEnd; found = scan.next(event)) {
    tally.pass(scan.offset());
    if (!isFound(found)) {
      tally.damage(scan.damageOffset(), scan.damage());
    } else if (wanted(event)) {
      in_order.add(event, event.offset);
    }
  }
  in_order.finish();
  log.out_of_order = in_order.outOfOrder();
  return log;
}

/// Decoders of the connections of a bag, created at their first messages.
class BagDecoders {
 public:
  BagDecoders(const std::string& prefix, const Kinds& kinds) : prefix_(prefix), kinds_(kinds) {}

  /// None if the definition is invalid.
  std::optional<BagDecoder>& of(const BagConnection* connection) {
    const auto [place, is_new] = decoders_.try_emplace(connection);
    std::optional<BagDecoder>& decoder = place->second;
    if (is_new) {
      try {
        decoder.emplace(*connection);
      } catch (const RejectedMessage&) {
        // None: messages of this connection are rejected.
      }
      if (decoder && decoder->kind() != nullptr && decoder->prefix() != prefix_ &&
          !decoder->prefix().empty() && isOneOf(kinds_, decoder->kind())) {
        elsewhere_.insert(decoder->prefix());
      }
    }
    return decoder;
  }
  bool wants(const BagMessage& message) {
    const std::optional<BagDecoder>& decoder = of(message.connection);
    return message.data != nullptr &&
           (!decoder || (isOneOf(kinds_, decoder->kind()) &&
                         (decoder->prefix() == prefix_ ||
                          (decoder->isJointState() && decoder->prefix().empty()))));
  }
  const std::set<std::string>& elsewhere() const { return elsewhere_; }

 private:
  const std::string& prefix_;
  const Kinds& kinds_;
  std::map<const BagConnection*, std::optional<BagDecoder>> decoders_;
  std::set<std::string> elsewhere_;
};

LoggedMessages readBag(const std::string& path, const std::string& prefix, const Kinds& kinds,
                       const TakeLogged& take, const LogProgress& advanced) {
  BagScan scan(path);
  LoggedMessages log;
  log.size = scan.size();
  Tally tally(log, take, advanced);
  BagDecoders decoders(prefix, kinds);
  TimeOrder<BagMessage> in_order(
      [&] {
        BagDecoders first_pass(prefix, kinds);
        return largestDelay<BagScan, BagMessage>(
            path, [&](const BagMessage& message) { return first_pass.wants(message); });
      }(),
      [&](const BagMessage& message, std::uint64_t) {
        tally.message(message.time / kMicrosecond, [&]() -> Message {
          std::optional<BagDecoder>& decoder = decoders.of(message.connection);
          if (!decoder) {
            throw RejectedMessage("a message definition that cannot be read");
          }
          return decoder->decode(message);
        });
      });
  BagMessage message;
  for (auto found = scan.next(message); found != BagScan::Found::kEnd; found = scan.next(message)) {
    tally.pass(scan.offset());
    if (!isFound(found)) {
      tally.damage(scan.damageOffset(), scan.damage());
    } else if (decoders.wants(message)) {
      in_order.add(message, scan.offset());
    }
  }
  in_order.finish();
  log.elsewhere = decoders.elsewhere();
  log.out_of_order = in_order.outOfOrder();
  return log;
}

}  // namespace

LoggedMessages readLoggedMessages(const std::string& path, const std::string& prefix,
                                  const Kinds& kinds, const TakeLogged& take,
                                  const LogProgress& advanced, LogOrder order) {
  return BagScan::isBag(path) ? readBag(path, prefix, kinds, take, advanced)
                              : readLcmLog(path, prefix, kinds, take, advanced, order);
}

std::string outOfOrder(const LoggedMessages& log) {
  return fmt::format("{} of {} messages are after a later one: sorted by their recorded times",
                     log.out_of_order, log.taken + log.rejected);
}

std::string foundElsewhere(const LoggedMessages& log) {
  std::string found = fmt::format("found none in {} bytes", log.size);
  if (!log.first_damage.empty()) {
    found += fmt::format(", of which {} place{} cannot be read, the first at {}", log.damaged,
                         log.damaged == 1 ? "" : "s", log.first_damage);
  }
  return log.elsewhere.empty()
             ? found
             : fmt::format("{}, but with {}", found,
                           printable(fmt::format("{}", fmt::join(log.elsewhere, ", "))));
}

}  // namespace whirl_twin
