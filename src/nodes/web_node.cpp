// web_node: serves a running twin in a browser and by Foxglove's WebSocket protocol, as `twin
// serve` does. It receives the topics of the twin in its namespace, of a played log as well, and
// passes commands to the services of simulation_node and monitor_node.
#include <diagnostic_updater/diagnostic_updater.h>
#include <fmt/format.h>
#include <ros/callback_queue.h>
#include <ros/ros.h>

#include <algorithm>
#include <boost/algorithm/string.hpp>
#include <cctype>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <string>
#include <utility>

#include "messages/input_error.h"
#include "messages/names.h"
#include "nodes/changed_parameters.h"
#include "nodes/duplicate_publishers.h"
#include "nodes/node_parameters.h"
#include "nodes/run_node.h"
#include "nodes/web_bridge.h"
#include "plugins/plugins.h"
#include "scene/scene_reader.h"
#include "transport/ros_parameters.h"
#include "transport/twin_namespace.h"
#include "web/web_files.h"

namespace whirl_twin {
namespace {

struct WebParameters {
  int port = 8765;
  std::string address = "127.0.0.1", token, origins, simulation = "simulation_node",
              monitor = "monitor_node";
  double rate = 100.0;  ///< [Hz, simulated]
  bool read_only = false;
};

NodeParameters table(WebParameters& p) {
  NodeParameters all("web_node",
                     "Serves a running twin in a browser and to viewers (Foxglove's WebSocket "
                     "protocol), as\n`twin serve` does.");
  all.whole("port", p.port, 0, UINT16_MAX, "TCP port; 0: any free one")
      .text("address", p.address, "",
            "IP address to listen on; any but this machine's needs ~token")
      .text("token", p.token, "none", "required in the URL: letters, digits, - and _, at least 16")
      .text("origins", p.origins, "none", "further pages that may connect, separated by commas")
      .flag("read_only", p.read_only, "clients can change nothing")
      .number("rate", p.rate, {1.0e-3, 1.0e5, "Hz", "every one that is published"},
              "states per simulated second to clients")
      .text("simulation", p.simulation, "", "the node whose services are called")
      .text("monitor", p.monitor, "", "the monitor whose services are called");
  return all;
}

constexpr double kWebPoll = 0.005;  // s

WebBridgeSettings settingsOf(const WebParameters& given) {
  constexpr std::size_t kShortestToken = 16;
  const bool legal = std::all_of(given.token.begin(), given.token.end(), [](unsigned char c) {
    return std::isalnum(c) != 0 || c == '-' || c == '_';
  });
  if (given.token.empty() ? !isLoopback(given.address)
                          : !legal || given.token.size() < kShortestToken) {
    throw InputError(fmt::format(
        "{}/token: must be at least {} letters, digits, - or _ for ~address {}, found {}",
        ros::this_node::getName(), kShortestToken, given.address,
        given.token.empty() ? "none" : fmt::format("{} characters", given.token.size())));
  }
  WebBridgeSettings settings;
  settings.access.address = given.address;
  settings.access.port = static_cast<std::uint16_t>(given.port);
  settings.access.token = given.token;
  if (!given.origins.empty()) {
    boost::split(settings.access.origins, given.origins, boost::is_any_of(", "),
                 boost::token_compress_on);
  }
  settings.files = readPage(pageFolder());
  settings.rate = given.rate;
  settings.read_only = given.read_only;
  settings.simulation = ros::names::resolve(given.simulation);
  settings.monitor = ros::names::resolve(given.monitor);
  return settings;
}

/// The server of the twin with the scene that the master has, again where that is another one. A
/// master that is restarted has none for a while: until then the server stays.
class ServedScene {
 public:
  explicit ServedScene(WebBridgeSettings settings) : settings_(std::move(settings)) {}

  void refresh() {
    const ros::NodeHandle node(twinNamespace());
    XmlRpc::XmlRpcValue tree;
    if (!node.getParam("scene", tree) || tree.toXml() == tree_) {
      return;
    }
    tree_ = tree.toXml();
    bridge_.reset();
    try {
      const ParameterTree given = parameterTree(node, "scene");
      bridge_ = std::make_unique<WebBridge>(build(readScene(given.tree, given.source)), settings_);
      settings_.access.port = bridge_->access().port;  // clients connect again to the same one
      fmt::print("web_node: open {}\n", urlOf(bridge_->access()));
      std::fflush(stdout);  // ROS's log reaches a file only when its buffer is full
    } catch (const InputError& error) {
      ROS_ERROR("the scene of the twin is not served:\n%s", error.what());
    }
  }
  WebBridge* bridge() { return bridge_.get(); }

 private:
  WebBridgeSettings settings_;
  std::string tree_;  // of the scene, as last read
  std::unique_ptr<WebBridge> bridge_;
};

void run() {
  WebParameters parameters;
  table(parameters).read();
  usePlugins();
  ServedScene served(settingsOf(parameters));
  MasterWatch master;
  diagnostic_updater::Updater diagnostics;
  diagnostics.setHardwareID("none");
  diagnostics.add("web server", [&](diagnostic_updater::DiagnosticStatusWrapper& status) {
    using diagnostic_msgs::DiagnosticStatus;
    if (!served.bridge()) {
      return status.summary(DiagnosticStatus::WARN, "waiting for the scene of the twin");
    }
    const WebCounts& counts = served.bridge()->counts();
    status.summary(DiagnosticStatus::OK, fmt::format("{} clients", counts.clients.load()));
    status.add("messages sent", counts.sent.load());
    status.add("messages lost by slow clients", counts.dropped.load());
    status.add("requests refused", counts.refused.load());
    status.add("malformed requests", counts.malformed.load());
  });
  reportMaster(master, diagnostics);
  ChangedParameters changed(master);
  changed.report(diagnostics);

  double next_second = 0.0;  // [s]
  while (ros::ok() && !stopRequested()) {
    ros::getGlobalCallbackQueue()->callAvailable(ros::WallDuration(kWebPoll));
    const double now = ros::SteadyTime::now().toSec();
    if (now >= next_second) {
      next_second = now + 1.0;
      served.refresh();
      if (served.bridge()) {
        served.bridge()->discover(now);
      }
      diagnostics.force_update();
    }
    if (served.bridge()) {
      served.bridge()->update(now);
    }
  }
  master.stop();
  ros::shutdown();  // ends calls of services in progress
}

}  // namespace
}  // namespace whirl_twin

int main(int argc, char** argv) {
  return whirl_twin::runNode(argc, argv, "web_node", whirl_twin::helpOf(whirl_twin::table),
                             whirl_twin::run);
}
