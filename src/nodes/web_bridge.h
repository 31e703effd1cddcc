// From ROS to the web server: messages of a twin and its monitor, of a log that is played as well,
// become those of the channels, and pictures of its systems.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>

#include "analysis/shape_expansion.h"
#include "display/scene_dynamics.h"
#include "display/twin_listener.h"
#include "nodes/web_commands.h"
#include "scene/built_scene.h"
#include "twin/step_messages.h"
#include "web/protocol.h"
#include "web/system_picture.h"
#include "web/web_channels.h"
#include "web/web_server.h"

namespace whirl_twin {

struct WebBridgeSettings {
  WebAccess access;
  WebFiles files;
  double rate = 100.0;  ///< [Hz, simulated], of the states that clients receive; 0: every one
  bool read_only = false;
  std::string simulation, monitor;  ///< nodes whose services are called
};

class WebBridge {
 public:
  /// Of the twin of this node, with this scene. Throws InputError, RunFailure.
  WebBridge(const BuiltScene& scene, const WebBridgeSettings& settings);
  ~WebBridge();
  WebBridge(const WebBridge&) = delete;
  WebBridge& operator=(const WebBridge&) = delete;

  const WebAccess& access() const { return server_.access(); }
  const WebCounts& counts() const { return server_.counts(); }

  /// What is due; to be called many times a second. now: [s], of a monotonic clock.
  void update(double now);
  /// Topics that are new, and counts; to be called once a second.
  void discover(double now);

 private:
  struct Shown {
    explicit Shown(const Dynamics& dynamics) : picture(dynamics) {}
    SystemPicture picture;
    PictureMotion motion;
    std::map<std::string, state::WhirlState> whirls;  // by the name that they are published under
    std::unique_ptr<ShapeExpansion> shape;            // of a rotor with stations
    bool has_shape = true;
  };

  template <class State>
  void take(const State& state);
  void show(const state::WhirlState& whirl);
  void show(const state::PendulumState& pendulum);
  void moved(const std::string& system, const state::Instant& at, Shown& shown);
  void note(const state::LoopStatistics& loop);
  template <class State>
  void note(const State&) {}
  void setParameters(const ParameterChange& change);
  bool isDue(const std::string& topic, std::int64_t step);
  void setStamp(std::int64_t stamp);
  void drawRotor(const std::string& system, Shown& shown) const;
  void sendPictures();
  std::string silence(double now) const;

  WebServer server_;
  WebCommands commands_;
  Protocol protocol_;
  WebChannels channels_;
  SceneDynamics scene_;
  TwinListener listener_;
  std::int64_t every_;                            // steps from one state of clients to the next
  std::map<std::string, std::int64_t> sent_;      // of each topic, the last multiple of every_
  std::map<std::string, Shown> shown_;            // by system
  std::map<std::string, std::string> system_of_;  // by the name that a whirl is published under
  std::int64_t behind_ = 0;                       // [ns], of stamps, so that they do not go back
  double heard_ = 0.0;                            // [s], of the last message of the twin
  double next_picture_ = 0.0;                     // [s]
};

}  // namespace whirl_twin
