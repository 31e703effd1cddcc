// A corrupt log is never accepted as a valid one, and never hangs or crashes its reader. The
// measured values themselves have no checksum; all framing data around them are checked.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <string>

#include "event_log_sample.h"
#include "transport/lcm_decode.h"
#include "transport/lcm_event_log.h"
#include "transport/payload_layout.h"

namespace whirl_twin {
namespace lcm_event_log_damage_test {

constexpr std::size_t kHeaderSize = 28;

/// An event of the valid log, found without the reader under test.
struct Extent {
  std::size_t begin;
  std::size_t channel;
  std::size_t payload;
  std::size_t end;
};

std::size_t number32(const Bytes& bytes, std::size_t at) {
  return std::size_t{bytes[at]} << 24 | std::size_t{bytes[at + 1]} << 16 |
         std::size_t{bytes[at + 2]} << 8 | bytes[at + 3];
}

std::vector<Extent> extentsOf(const Bytes& log) {
  std::vector<Extent> extents;
  for (std::size_t begin = 0; begin < log.size(); begin = extents.back().end) {
    const std::size_t payload = begin + kHeaderSize + number32(log, begin + 20);
    extents.push_back({begin, begin + kHeaderSize, payload, payload + number32(log, begin + 24)});
  }
  return extents;
}

/// Marks the bytes of a series' state that no one can check: measured numbers, flags and stamps.
void markMeasured(const std::string& layout, const Bytes& log, std::size_t at,
                  std::vector<bool>& watched) {
  at += 8;
  std::size_t length = 0;
  const auto pass = [&](std::size_t bytes, bool is_watched) {
    std::fill_n(watched.begin() + static_cast<std::ptrdiff_t>(at), bytes, is_watched);
    at += bytes;
  };
  for (const char& field : layout) {
    // utime, stamp, step; utime has to be the time, and a step to follow the step before.
    const bool is_instant = &field == &layout[0] || &field == &layout[2];
    switch (field) {
      case 'l':
        pass(8, is_instant);
        break;
      case 's':
        pass(4 + number32(log, at), true);
        break;
      case 'n':
        length = number32(log, at);
        pass(4, true);
        break;
      case 'S':
        for (std::size_t i = 0; i < length; ++i) {
          pass(4 + number32(log, at), true);
        }
        break;
      case 'D':
        pass(8 * length, false);
        break;
      default:
        pass(field == 'b' ? 1 : 8, false);
    }
  }
}

/// Which bytes of the log cannot change unnoticed.
std::vector<bool> watchedBytes(const Bytes& log) {
  std::vector<bool> watched(log.size(), true);
  for (const auto& extent : extentsOf(log)) {
    // A timestamp may be off by a second, and the last one by anything ahead.
    std::fill_n(watched.begin() + static_cast<std::ptrdiff_t>(extent.begin) + 12, 8, false);
    const std::string channel(log.begin() + static_cast<std::ptrdiff_t>(extent.channel),
                              log.begin() + static_cast<std::ptrdiff_t>(extent.payload));
    if (channel == "TWIN_ROTOR_WHIRL") {
      markMeasured(layoutOf<state::WhirlState>(), log, extent.payload, watched);
    } else if (channel == "TWIN_ARM_PENDULUM") {
      markMeasured(layoutOf<state::PendulumState>(), log, extent.payload, watched);
    } else if (channel == "TWIN_SHAFT_DRIVE") {
      markMeasured(layoutOf<state::DriveState>(), log, extent.payload, watched);
    } else {
      // Messages of a monitor are not states: only their type is checked here.
      std::fill(watched.begin() + static_cast<std::ptrdiff_t>(extent.payload) + 8,
                watched.begin() + static_cast<std::ptrdiff_t>(extent.end), false);
    }
  }
  return watched;
}

bool passesForSound(const Bytes& log) {
  const auto summary = summaryOf(log);
  return summary.intact() && summary.continuous();
}

TEST(DamagedEventLog, CutBetweenTwoEventsIsShorterAndCutWithinOneIsTruncated) {
  const auto whole = sampleLog(3);
  std::size_t next = 0;
  const auto extents = extentsOf(whole);
  for (std::size_t length = 0; length <= whole.size(); ++length) {
    const auto summary = summaryOf(Bytes(whole.begin(), whole.begin() + static_cast<long>(length)));
    while (next < extents.size() && extents[next].end <= length) {
      ++next;
    }
    const bool between = next == 0 ? length == 0 : extents[next - 1].end == length;
    EXPECT_EQ(summary.events, next) << length;
    EXPECT_EQ(summary.truncated, !between) << length;
    EXPECT_EQ(summary.intact(), between && length > 0) << length;
  }
}

TEST(DamagedEventLog, IsNoticedWhicheverWatchedBitFlips) {
  const auto sound = sampleLog(3);
  ASSERT_TRUE(passesForSound(sound));
  const auto watched = watchedBytes(sound);
  ASSERT_GT(std::count(watched.begin(), watched.end(), true), 700);
  auto log = sound;
  for (std::size_t at = 0; at < log.size(); ++at) {
    if (!watched[at]) {
      continue;
    }
    for (int bit = 0; bit < 8; ++bit) {
      log[at] = static_cast<std::uint8_t>(sound[at] ^ (1 << bit));
      EXPECT_FALSE(passesForSound(log)) << "byte " << at << " bit " << bit;
    }
    log[at] = sound[at];
  }
}

TEST(DamagedEventLog, IsNoticedAfterBytesWereOverwrittenLostOrAdded) {
  const auto sound = sampleLog(5);
  const auto watched = watchedBytes(sound);
  const auto extents = extentsOf(sound);
  std::mt19937 random(20240501);
  const auto below = [&random](std::size_t limit) { return random() % limit; };
  for (int mutation = 0; mutation < 500; ++mutation) {
    auto log = sound;
    const std::size_t at = below(log.size());
    const std::size_t length = std::min(1 + below(40), log.size() - at);
    const auto from = log.begin() + static_cast<std::ptrdiff_t>(at);
    const auto to = from + static_cast<std::ptrdiff_t>(length);
    bool must_be_noticed = true;
    switch (below(4)) {
      case 0:
        std::generate(from, to, [&] { return static_cast<std::uint8_t>(random()); });
        break;
      case 1:
        std::fill(from, to, std::uint8_t{0});
        break;
      case 2:
        log.erase(from, to);
        break;
      default:
        log.insert(from, length, static_cast<std::uint8_t>(random()));
    }
    if (log.size() == sound.size()) {
      must_be_noticed = false;
      for (std::size_t i = 0; i < log.size(); ++i) {
        must_be_noticed = must_be_noticed || (watched[i] && log[i] != sound[i]);
      }
      // An event with corrupt channel and type is counted as another program's.
      const auto changed = [&](std::size_t begin, std::size_t end) {
        return !std::equal(log.begin() + static_cast<std::ptrdiff_t>(begin),
                           log.begin() + static_cast<std::ptrdiff_t>(end),
                           sound.begin() + static_cast<std::ptrdiff_t>(begin));
      };
      must_be_noticed =
          must_be_noticed && std::none_of(extents.begin(), extents.end(), [&](const auto& extent) {
            return changed(extent.channel, extent.payload) &&
                   changed(extent.payload, extent.payload + 8);
          });
    }
    const auto summary = summaryOf(log);
    EXPECT_LE(summary.events, extents.size());
    if (must_be_noticed) {
      EXPECT_FALSE(summary.intact() && summary.continuous())
          << "mutation " << mutation << ", " << length << " bytes at " << at;
    }
  }
}

TEST(DamagedEventLog, IsNoticedWhenAnEventIsTakenOutOrRepeated) {
  const auto sound = sampleLog(4);
  const auto extents = extentsOf(sound);
  for (std::size_t i = 0; i + 1 < extents.size(); ++i) {
    const auto begin = sound.begin() + static_cast<std::ptrdiff_t>(extents[i].begin);
    const auto end = sound.begin() + static_cast<std::ptrdiff_t>(extents[i].end);
    Bytes without(sound.begin(), begin);
    without.insert(without.end(), end, sound.end());
    EXPECT_FALSE(passesForSound(without)) << "without event " << i;
    Bytes twice(sound.begin(), end);
    twice.insert(twice.end(), begin, sound.end());
    EXPECT_FALSE(passesForSound(twice)) << "event " << i << " twice";
  }
}

TEST(DamagedEventLog, IsReadOnAfterTheDamage) {
  auto log = sampleLog(100);
  const auto extents = extentsOf(log);
  log[extents[50].begin] ^= 0xff;         // a sync word
  log[extents[100].begin + 25] ^= 0x10;   // a payload length
  log[extents[150].payload + 3] ^= 0x01;  // a fingerprint
  const auto summary = summaryOf(log);
  EXPECT_FALSE(summary.intact());
  EXPECT_FALSE(summary.truncated);
  // The event before a corrupt sync word is lost with it: its length cannot be verified.
  EXPECT_EQ(summary.events, 302u - 4u);
  EXPECT_EQ(summary.defect_count, 3u);
  ASSERT_EQ(summary.defects.size(), 3u);
  EXPECT_EQ(summary.defects[0].offset, extents[49].begin);
  EXPECT_EQ(summary.defects[1].offset, extents[100].begin);
  EXPECT_EQ(summary.defects[2].offset, extents[150].begin);
}

TEST(DamagedEventLog, ThatIsNoLogAtAllHasNoEvents) {
  std::mt19937 random(7);
  Bytes noise(100000);
  std::generate(noise.begin(), noise.end(), [&] { return static_cast<std::uint8_t>(random()); });
  Bytes syncs;
  for (int i = 0; i < 50000; ++i) {
    syncs.insert(syncs.end(), {0xed, 0xa1, 0xda, 0x01});
  }
  for (const auto& bytes : {noise, syncs, Bytes(3000000, 0), Bytes{0xed}, Bytes{'a', ',', 'b'}}) {
    const auto summary = summaryOf(bytes);
    EXPECT_EQ(summary.events, 0u);
    EXPECT_FALSE(summary.intact());
    EXPECT_EQ(summary.unreadable_bytes, bytes.size());
    EXPECT_LE(summary.defects.size(), kMaxNamedDefects);
  }
}

TEST(DamagedEventLog, WhoseClockWasSetBackIsNoticed) {
  const TemporaryLog log;
  EventLogWriter writer(log.path());
  writer.write(whirlAt(5000));
  writer.write(driveAt(3000));  // two seconds earlier
  writer.finish();
  EXPECT_FALSE(readEventLog(log.path()).intact());
}

}  // namespace lcm_event_log_damage_test
}  // namespace whirl_twin
