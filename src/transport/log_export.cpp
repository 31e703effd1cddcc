#include "transport/log_export.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "messages/message_check.h"
#include "messages/names.h"
#include "transport/bag_scan.h"
#include "transport/event_scan.h"
#include "transport/lcm_decode.h"
#include "transport/ros_encode.h"
#include "transport/time_order.h"

namespace whirl_twin {
namespace {

class Exporter {
 public:
  Exporter(LogExport& log, RecordingWriter& to, const LogProgress& advanced)
      : log_(log), to_(to), advanced_(advanced) {}

  void pass(std::uint64_t offset) {
    if (++places_ % kMessagesPerProgress == 0) {
      advanced_(offset, log_.size);
    }
  }
  void damage(std::uint64_t offset, const std::string& what) {
    ++log_.damaged;
    name(offset, what);
  }
  /// write() writes a message and returns its topic, or throws RejectedMessage.
  template <class Write>
  void message(std::uint64_t offset, const std::string& channel, Write&& write) {
    try {
      ++log_.topics[write(to_)];
      ++log_.messages;
    } catch (const RejectedMessage& why) {
      ++log_.rejected;
      name(offset, printable(channel) + ": " + why.what());
    }
  }

 private:
  void name(std::uint64_t offset, std::string what) {
    if (log_.defects.size() < kMaxNamedDefects) {
      log_.defects.push_back({offset, std::move(what)});
    }
  }

  LogExport& log_;
  RecordingWriter& to_;
  const LogProgress& advanced_;
  std::uint64_t places_ = 0;
};

[[noreturn]] void rejectTooLong(std::uint64_t size) {
  throw RejectedMessage(
      fmt::format("payload: expected at most {} bytes, found {}", EventScan::kMaxPayload, size));
}

void exportLcmLog(const std::string& path, const std::string& prefix, const Selects& selects,
                  LogExport& log, Exporter& exporter) {
  EventScan scan(path);
  log.size = scan.size();
  RosEncoder encoder(namespaceOfPrefix(prefix));
  const auto wanted = [&](const RawEvent& event) {
    return parseChannel(event.channel, prefix) && selects(event.channel);
  };
  TimeOrder<RawEvent> in_order(
      largestDelay<EventScan, RawEvent>(path, wanted),
      [&](const RawEvent& event, std::uint64_t offset) {
        exporter.message(offset, event.channel, [&](RecordingWriter& to) {
          if (event.data == nullptr) {
            rejectTooLong(event.size);
          }
          requireRange("timestamp", event.timestamp, 0, kMaxStamp / kMicrosecond);
          const LittleEndian& bytes =
              encoder.encode(decodeEvent(event.channel, event.data, event.size, prefix));
          to.write(encoder.topic(), event.timestamp * kMicrosecond, bytes.data(), bytes.size());
          return encoder.topic().topic;
        });
      });
  RawEvent event;
  for (auto found = scan.next(event); found != EventScan::Found::kEnd; found = scan.next(event)) {
    exporter.pass(scan.offset());
    if (found != EventScan::Found::kEvent) {
      exporter.damage(scan.damageOffset(), scan.damage());
    } else if (!parseChannel(event.channel, prefix)) {
      ++log.foreign[printable(event.channel)];
    } else if (!selects(event.channel)) {
      ++log.not_selected;
    } else {
      in_order.add(event, event.offset);
    }
  }
  in_order.finish();
}

void exportBag(const std::string& path, const Selects& selects, LogExport& log,
               Exporter& exporter) {
  BagScan scan(path);
  log.size = scan.size();
  TimeOrder<BagMessage> in_order(
      largestDelay<BagScan, BagMessage>(
          path, [&](const BagMessage& message) { return selects(message.connection->topic); }),
      [&](const BagMessage& message, std::uint64_t offset) {
        exporter.message(offset, message.connection->topic, [&](RecordingWriter& to) {
          if (message.data == nullptr) {
            rejectTooLong(message.size);
          }
          to.write(*message.connection, message.time, message.data, message.size);
          return message.connection->topic;
        });
      });
  BagMessage message;
  for (auto found = scan.next(message); found != BagScan::Found::kEnd; found = scan.next(message)) {
    exporter.pass(scan.offset());
    if (found != BagScan::Found::kMessage) {
      exporter.damage(scan.damageOffset(), scan.damage());
    } else if (!selects(message.connection->topic)) {
      ++log.not_selected;
    } else {
      in_order.add(message, scan.offset());
    }
  }
  in_order.finish();
}

}  // namespace

std::string namespaceOfPrefix(const std::string& prefix) {
  std::string name = prefix.substr(0, prefix.find_last_not_of('_') + 1);
  std::transform(name.begin(), name.end(), name.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return "/" + name;
}

LogExport exportLog(const std::string& path, const std::string& prefix, const Selects& selects,
                    RecordingWriter& to, const LogProgress& advanced) {
  LogExport log;
  Exporter exporter(log, to, advanced);
  if (BagScan::isBag(path)) {
    exportBag(path, selects, log, exporter);
  } else {
    exportLcmLog(path, prefix, selects, log, exporter);
  }
  return log;
}

}  // namespace whirl_twin
