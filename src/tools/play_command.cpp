// `twin play`.
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <optional>

#include "messages/input_error.h"
#include "reports/output.h"
#include "requests/durations.h"
#include "tools/arguments.h"
#include "tools/commands.h"
#include "tools/interrupt.h"
#include "tools/keyboard.h"
#include "tools/report_options.h"
#include "transport/lcm_connection.h"
#include "transport/playable_log.h"

namespace whirl_twin {

namespace {

constexpr const char* kPlayDescription =
    "Plays an LCM log on LCM, at the recorded or another rate, from any instant, and exits.";

constexpr const char* kPlayFooter =
    "Keys, in a terminal: space pauses and resumes, s plays one event and pauses, + and - double "
    "and\n"
    "halve the rate, the arrows move 10 s forward and back, q quits.\n"
    "\n"
    "Corrupt and invalid events and repeated states are left out, and counted and listed with "
    "their\n"
    "byte offset, as gaps are. Commands to a twin or a monitor are sent only with --commands. "
    "Where\n"
    "the log has no event for more than a minute, playback waits one second. At the end, and "
    "while\n"
    "playback is paused, TWIN_LOOP reports a paused run, so that no monitor raises a timeout.\n"
    "Exit status: 0 played, 1 LCM could not send, 2 a log that cannot be played.\n"
    "\n"
    "Examples:\n"
    "  twin play night.lcmlog --start 3600 --duration 60 --rate 10\n"
    "  twin play night.lcmlog --rate max --channel '*_WHIRL'";

using Clock = std::chrono::steady_clock;
using std::chrono::nanoseconds;

constexpr double kSlowestRate = 0.1, kFastestRate = 1000.0;
constexpr std::int64_t kSecondOfLog = 1'000'000;           // us
constexpr std::int64_t kMaxWait = 60 * kSecondOfLog;       // of the log, without events
constexpr std::int64_t kBackAndForth = 10 * kSecondOfLog;  // of the arrows
constexpr std::uint64_t kUnlookedEvents =
    256;  // maximum number of events between two polls of the keys

struct PlayRequest {
  std::string file;
  std::string rate = "1";
  std::string url = kDefaultLcmUrl;
  std::string lcm_prefix = kDefaultLcmPrefix;
  double start = 0.0;  // s
  std::optional<double> duration;
  ChannelFilter channels;
  bool commands = false;
  bool loop = false;
  bool json = false;
};

/// Speed factor relative to the recording; 0: as fast as possible.
double rateOf(const std::string& text) {
  if (text == "max") {
    return 0.0;
  }
  char* end = nullptr;
  const double rate = std::strtod(text.c_str(), &end);
  if (text.empty() || *end != '\0' || !(rate >= kSlowestRate && rate <= kFastestRate)) {
    throw InputError(fmt::format("--rate: expected {} to {}, or max, found '{}'", kSlowestRate,
                                 kFastestRate, text));
  }
  return rate;
}

constexpr OptionQuantity kLogTime{"a time", "s", 0.0, 1.0e10};

std::int64_t microseconds(double seconds) {
  return std::llround(seconds * static_cast<double>(kSecondOfLog));
}

class Player {
 public:
  explicit Player(const PlayRequest& request)
      : rate_(rateOf(request.rate)),
        loop_(request.loop),
        log_(
            request.file, request.lcm_prefix,
            [&request](const std::string& channel) { return selects(request.channels, channel); },
            request.commands) {
    if (!log_.begin()) {
      throw InputError(fmt::format("{}: expected an LCM log, found no event in {} bytes",
                                   request.file, log_.size()));
    }
    from_ = *log_.begin() + microseconds(request.start);
    if (request.start > 0.0 && from_ > *log_.end()) {
      throw InputError(fmt::format("--start: expected at most the log's {:g} s, found {:g} s",
                                   inSeconds(*log_.end()), request.start));
    }
    until_ = request.duration ? from_ + microseconds(*request.duration)
                              : std::numeric_limits<std::int64_t>::max();
    lcm_ = openLcm(request.url);
    run_.emplace(
        lcm_, request.lcm_prefix,
        std::chrono::duration_cast<nanoseconds>(std::chrono::system_clock::now().time_since_epoch())
            .count());
  }

  void play() {
    begin();
    while (!ended_ && !interrupted()) {
      const RawEvent* const event = log_.next();
      if (event == nullptr || event->timestamp > until_) {
        if (!loop_ || log_.played().events == played_before_) {
          break;  // also if there is nothing to repeat
        }
        goTo(from_);
        played_before_ = log_.played().events;
        continue;
      }
      if (awaits(event->timestamp)) {
        send(*event);
      }
    }
    if (!held_) {
      run_->hold(true);
    }
    show(true);
  }

  const PlayableLog& log() const { return log_; }
  std::uint64_t sent() const { return sent_; }
  std::uint64_t failed() const { return failed_; }
  std::uint64_t cuts() const { return cuts_; }

 private:
  /// [s], since the beginning of the log.
  double inSeconds(std::int64_t timestamp) const {
    return static_cast<double>(timestamp - *log_.begin()) / static_cast<double>(kSecondOfLog);
  }

  void begin() {
    if (from_ > *log_.begin()) {
      log_.seek(from_);
    }
    at_ = from_;
    anchor();
  }

  /// Makes the next event due now.
  void anchor(nanoseconds later = nanoseconds(0)) {
    anchor_wall_ = Clock::now() + later;
    anchor_log_ = at_;
  }

  void goTo(std::int64_t timestamp) {
    log_.seek(timestamp);
    run_->jump();
    at_ = timestamp;
    anchor();
  }

  /// Waits until it is due; false if a key has changed the position.
  bool awaits(std::int64_t timestamp) {
    if (timestamp - at_ > kMaxWait || at_ - timestamp > kSecondOfLog) {
      ++cuts_;
      at_ = timestamp;
      anchor(std::chrono::seconds(1));
    }
    at_ = timestamp;
    moved_ = false;
    do {
      const nanoseconds left = held_ ? nanoseconds(std::chrono::seconds(1)) : due(timestamp);
      const bool look = left.count() > 0 || ++unlooked_ >= kUnlookedEvents;
      if (look) {
        unlooked_ = 0;
        show(false);
        obey(keys_.wait(std::clamp(left, nanoseconds(0), kOften)));
      }
    } while (!ended_ && !moved_ && !interrupted() && (held_ || due(timestamp).count() > 0));
    return !ended_ && !moved_ && !interrupted();
  }

  nanoseconds due(std::int64_t timestamp) const {
    if (rate_ == 0.0 || steps_ > 0) {
      return nanoseconds(0);
    }
    const double after = 1.0e3 * static_cast<double>(timestamp - anchor_log_) / rate_;
    return anchor_wall_ + nanoseconds(std::llround(after)) - Clock::now();
  }

  void obey(const std::optional<Key>& key) {
    if (!key) {
      return;
    }
    switch (*key) {
      case Key::kSpace:
        hold(!held_);
        break;
      case Key::kStep:
        steps_ = 1;
        hold(false);
        break;
      case Key::kFaster:
      case Key::kSlower:
        if (rate_ > 0.0) {
          rate_ = std::clamp(*key == Key::kFaster ? 2.0 * rate_ : 0.5 * rate_, kSlowestRate,
                             kFastestRate);
          anchor();
        }
        break;
      case Key::kForward:
      case Key::kBack:
        goTo(std::clamp(*key == Key::kForward ? at_ + kBackAndForth : at_ - kBackAndForth, from_,
                        std::max(from_, *log_.end())));
        moved_ = true;
        break;
      case Key::kQuit:
        ended_ = true;
    }
  }

  void hold(bool held) {
    held_ = held;
    run_->hold(held);
    anchor();
  }

  void send(const RawEvent& event) {
    if (log_.message() && run_->take(*log_.message())) {
      return;
    }
    const bool failed =
        lcm_->publish(event.channel, event.data, static_cast<unsigned>(event.size)) != 0;
    ++(failed ? failed_ : sent_);
    if (steps_ > 0 && --steps_ == 0) {
      hold(true);
    }
  }

  void show(bool last) {
    if (!terminal_ || (!last && Clock::now() < next_show_)) {
      return;
    }
    next_show_ = Clock::now() + kOften;
    const std::string rate = rate_ > 0.0 ? fmt::format("x {:g}", rate_) : "max";
    fmt::print(stderr, "\r{:10.3f} of {:.3f} s  {}  {}  \x1b[K{}", inSeconds(at_),
               inSeconds(*log_.end()), rate, held_ ? "paused" : "", last ? "\n" : "");
    std::fflush(stderr);
  }

  static constexpr nanoseconds kOften = std::chrono::milliseconds(100);

  double rate_;
  bool loop_;
  PlayableLog log_;
  std::shared_ptr<lcm::LCM> lcm_;
  std::optional<PlayedRun> run_;
  Keyboard keys_;
  const bool terminal_ = ::isatty(STDERR_FILENO) == 1;
  std::int64_t from_ = 0, until_ = 0, at_ = 0;  ///< [us], of the log
  Clock::time_point anchor_wall_, next_show_;
  std::int64_t anchor_log_ = 0;
  std::uint64_t unlooked_ = 0, played_before_ = 0;
  std::uint64_t sent_ = 0, failed_ = 0, cuts_ = 0;
  int steps_ = 0;
  bool held_ = false, ended_ = false, moved_ = false;
};

std::string playText(const Player& player) {
  const PlayedLog& log = player.log().played();
  std::string out = fmt::format("{} events sent\n", player.sent());
  const auto say = [&out](std::uint64_t count, const char* what) {
    out += count > 0 ? fmt::format("{} {}\n", count, what) : "";
  };
  say(player.failed(), "that LCM could not send");
  say(log.commands, "commands not sent (--commands sends them)");
  say(log.not_selected, "on channels that were not selected");
  say(log.rejected, "corrupt events left out");
  say(log.damaged, "corrupt places left out");
  say(log.repeated, "repeated states left out");
  say(log.gaps, "gaps in the steps");
  say(player.cuts(), "jumps of the log's time, skipped");
  for (const LogDefect& defect : log.defects) {
    out += fmt::format("  at byte {}: {}\n", defect.offset, defect.what);
  }
  return out;
}

Json playJson(const PlayRequest& request, const Player& player) {
  const PlayedLog& log = player.log().played();
  Json json = {{"file", request.file},      {"sent", player.sent()},
               {"failed", player.failed()}, {"commands", log.commands},
               {"rejected", log.rejected},  {"damaged", log.damaged},
               {"repeated", log.repeated},  {"gaps", log.gaps},
               {"jumps", player.cuts()},    {"not_selected", log.not_selected},
               {"defects", Json::array()}};
  for (const LogDefect& defect : log.defects) {
    json["defects"].push_back({{"offset", defect.offset}, {"what", defect.what}});
  }
  return json;
}

int play(const PlayRequest& request) {
  requireLcmPrefix(request.lcm_prefix);
  Player player(request);
  catchInterrupts();
  player.play();
  if (request.json) {
    printJson(playJson(request, player));
  } else {
    printText(playText(player));
  }
  return player.failed() == 0 ? kDone : kFailed;
}

}  // namespace

void addPlayCommand(const ProgramCommand& twin, int& status) {
  const ProgramCommand command = twin.subcommand("play", kPlayDescription);
  const auto request = std::make_shared<PlayRequest>();
  command.option("LOG", request->file, "LCM log, such as demo.lcmlog").required().type("");
  command.quantity("--start", request->start, kLogTime, "from the log's beginning", "0").type("S");
  command.quantity("--duration", request->duration, kLogTime, "of the log", "to its end").type("S");
  command.option("--rate", request->rate, "0.1 to 1000 times as recorded, or max; default: 1")
      .type("R");
  command.flag("--loop", request->loop, "repeat the log");
  addChannelOption(command, request->channels);
  command.flag("--commands", request->commands, "also send the log's commands to twin and monitor");
  command.option("--lcm-url", request->url, std::string("default: ") + kDefaultLcmUrl).type("URL");
  command
      .option("--lcm-prefix", request->lcm_prefix,
              "prefix of the recorded twin's channels; default: TWIN_")
      .type("PREFIX");
  addJsonOption(command, request->json);
  command.footer(kPlayFooter);
  command.callback([request, &status] { status = play(*request); });
}

}  // namespace whirl_twin
