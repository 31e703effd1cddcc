// terminal_node: prints the state of the twin in a terminal, for machines without a display.
//
// On a terminal, a line per system is rewritten in place five times a second; into a file or a
// pipe, a line is written once a second. Alerts raised and cleared are permanent lines.
#include <fmt/format.h>
#include <ros/ros.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <cstdio>

#include "display/terminal_text.h"
#include "display/twin_listener.h"
#include "messages/names.h"
#include "nodes/node_parameters.h"
#include "transport/master_watch.h"

namespace whirl_twin {
namespace {

class TerminalDisplay {
 public:
  TerminalDisplay() : is_terminal_(isatty(STDOUT_FILENO) == 1) {
    listener_.onAlerts([this](const AlertArray& alerts) { printAlerts(alerts.alerts); });
    listener_.discover();
    ros::NodeHandle node;
    discover_timer_ =
        node.createWallTimer(ros::WallDuration(1.0), [this](const auto&) { listener_.discover(); });
    print_timer_ = node.createWallTimer(ros::WallDuration(is_terminal_ ? 0.2 : 1.0),
                                        [this](const auto&) { print(); });
  }

 private:
  static std::size_t columns() {
    winsize size{};
    const bool known = ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0;
    return known ? size.ws_col : 80;
  }

  void print() {
    const std::string silence = listener_.monitorSilence();
    std::vector<std::string> readouts;
    for (const auto& [system, readout] : listener_.systems()) {
      if (readout.whirl || readout.pendulum) {
        SystemReadout known = readout;
        if (!silence.empty()) {
          known.margin.reset();  // an outdated margin would look live
        }
        readouts.push_back(readoutText(system, known));
      }
    }
    if (readouts.empty()) {
      return;
    }
    std::string time =
        fmt::format("{:.3f} s{}{}", listener_.time(), silence.empty() ? "" : " | ", silence);
    if (listener_.monitor()) {
      const std::string held = heldBackText(*listener_.monitor());
      time += held.empty() ? "" : " | " + held;
    }
    time += listener_.others().empty() ? "" : " | " + listener_.others();
    if (is_terminal_) {
      erase();
      show(time);
      for (const auto& readout : readouts) {
        show("  " + readout);
      }
    } else {
      put(fmt::format("{} | {}", time, fmt::join(readouts, " | ")));
    }
    flush();
  }

  void printAlerts(const std::vector<Alert>& alerts) {
    erase();
    for (const auto& line : alertChanges(alerts_, alerts, listener_.time())) {
      put(line);
    }
    alerts_ = alerts;
    flush();
  }

  void show(const std::string& line) {
    put(fitted(line, columns()));
    ++shown_;
  }

  /// Names and texts are not trusted: any publisher may set them.
  static void put(const std::string& line) { std::puts(printable(line, line.size()).c_str()); }

  // Cursor up to the lines to be rewritten, to the first column, clear below.
  void erase() {
    if (shown_ > 0) {
      std::printf("\x1b[%dA\r\x1b[J", shown_);
    }
    shown_ = 0;
  }

  static void flush() {
    if (std::fflush(stdout) != 0) {
      ros::shutdown();  // the reader of the pipe has closed it
    }
  }

  bool is_terminal_;
  int shown_ = 0;  // lines on the terminal that the next frame overwrites
  TwinListener listener_;
  std::vector<Alert> alerts_;
  ros::WallTimer discover_timer_;
  ros::WallTimer print_timer_;
};

}  // namespace
}  // namespace whirl_twin

int main(int argc, char** argv) {
  const whirl_twin::NodeParameters none(
      "terminal_node",
      "The state of a twin in a terminal: a line for each system, rewritten in place; alerts "
      "remain.\nTo a file or a pipe one line per second is written. It has no parameters.");
  if (whirl_twin::printsHelp(argc, argv, none.help())) {
    return 0;
  }
  ros::init(argc, argv, "terminal_node", ros::init_options::AnonymousName);
  ros::NodeHandle node;  // keeps ROS up between the first topic and the last
  const whirl_twin::TerminalDisplay display;
  const whirl_twin::MasterWatch master;
  ros::spin();
  return 0;
}
