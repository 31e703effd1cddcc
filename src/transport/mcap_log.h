// The twin's messages as an MCAP file at the time they are about: the same file as an LCM log of
// them, exported.
#pragma once

#include <string>

#include "transport/channels.h"
#include "transport/log_export.h"
#include "transport/mcap_writer.h"
#include "transport/ros_encode.h"

namespace whirl_twin {

class McapLog {
 public:
  /// Creates the file, or empties it. All throw RunFailure if it cannot be written.
  explicit McapLog(const std::string& path)
      : encoder_(namespaceOfPrefix(kDefaultLcmPrefix)), writer_(path) {}

  template <class State>
  void write(const State& state) {
    writeAt(timeOf(state), state);
  }
  /// The same at another time [s] than the message's own.
  template <class State>
  void writeAt(double time, const State& state) {
    const LittleEndian& bytes = encoder_.encode(state);
    writer_.write(encoder_.topic(), 1'000 * utimeOf(time), bytes.data(), bytes.size());
  }

  void finish() { writer_.finish(); }

 private:
  RosEncoder encoder_;
  McapWriter writer_;
};

}  // namespace whirl_twin
