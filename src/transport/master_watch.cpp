#include "transport/master_watch.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <ros/connection_manager.h>
#include <ros/network.h>
#include <ros/publication.h>
#include <ros/topic_manager.h>
#include <ros/xmlrpc_manager.h>

#include <algorithm>
#include <chrono>
#include <utility>

#include "messages/names.h"
#include "transport/channels.h"
#include "transport/twin_namespace.h"

namespace whirl_twin {

namespace {

constexpr std::size_t kMaxTrouble = 500;  // bytes of names

constexpr auto kPeriod = std::chrono::seconds(2);
constexpr auto kPoll = std::chrono::milliseconds(100);  // bounds the time to stop the thread

/// Calls the master with this node's name and further arguments; false if it does not answer.
bool ask(const std::string& method, const std::vector<std::string>& arguments,
         XmlRpc::XmlRpcValue& answer) {
  XmlRpc::XmlRpcValue request;
  XmlRpc::XmlRpcValue response;
  request[0] = ros::this_node::getName();
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    request[static_cast<int>(i) + 1] = arguments[i];
  }
  return ros::master::execute(method, request, response, answer, false);
}

/// Updates the publishers of a topic this node subscribes to, as the master does.
void connectTo(const std::string& topic, const XmlRpc::XmlRpcValue& publishers) {
  const std::string& uri = ros::XMLRPCManager::instance()->getServerURI();
  std::string host;
  std::uint32_t port = 0;
  if (!ros::network::splitURI(uri, host, port)) {
    return;
  }
  XmlRpc::XmlRpcValue request;
  XmlRpc::XmlRpcValue response;
  request[0] = "/master";
  request[1] = topic;
  request[2] = publishers;
  XmlRpc::XmlRpcClient* const client =
      ros::XMLRPCManager::instance()->getXMLRPCClient(host, static_cast<int>(port), "/");
  client->execute("publisherUpdate", request, response);
  ros::XMLRPCManager::instance()->releaseXMLRPCClient(client);
}

}  // namespace

std::int64_t stampNow() {
  const ros::Time now = ros::Time::now();
  const bool no_clock = ros::Time::isSimTime() && now.isZero();
  return no_clock ? static_cast<std::int64_t>(ros::WallTime::now().toNSec())
                  : static_cast<std::int64_t>(now.toNSec());
}

MasterWatch::MasterWatch(std::vector<std::string> parameters)
    : parameter_names_(std::move(parameters)) {
  parameter_names_.push_back(ros::this_node::getName());
  parameter_names_.push_back("/use_sim_time");  // for nodes started later
  thread_ = std::thread([this] { run(); });
}

MasterWatch::~MasterWatch() {
  stop();
}

void MasterWatch::stop() {
  ending_.store(true);
  if (thread_.joinable()) {
    thread_.join();
  }
}

std::string MasterWatch::trouble() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return trouble_.empty() ? clock_trouble_ : trouble_;
}

XmlRpc::XmlRpcValue MasterWatch::ownParameters() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return own_parameters_;
}

void MasterWatch::run() {
  auto next = std::chrono::steady_clock::now();
  while (!ending_.load()) {
    if (std::chrono::steady_clock::now() >= next && ros::isStarted() && ros::ok()) {
      look();
      next = std::chrono::steady_clock::now() + kPeriod;
    }
    std::this_thread::sleep_for(kPoll);
  }
}

void MasterWatch::look() {
  XmlRpc::XmlRpcValue state;
  if (!ask("getSystemState", {}, state)) {
    if (answered_) {
      ROS_WARN("the ROS master at %s does not answer: new nodes cannot connect until it is back",
               ros::master::getURI().c_str());
    }
    answered_ = false;
    const std::lock_guard<std::mutex> lock(mutex_);
    trouble_ = "the ROS master does not answer";
    return;
  }
  Registered now = registered(state);
  std::vector<std::string> advertised;
  ros::this_node::getAdvertisedTopics(advertised);
  const auto known = [&](const std::string& topic) { return now.topics.count(topic) > 0; };
  // A single missing topic may be on its way to the master for the first time: not a restart.
  const auto kept = std::count_if(advertised.begin(), advertised.end(), known);
  const bool restarted = !answered_ || kept == 0;
  if (kept < static_cast<std::ptrdiff_t>(advertised.size())) {
    tellAll();
    if (restarted) {
      ROS_WARN(
          "the ROS master was restarted: topics, services and parameters are registered again");
    }
  } else {
    services_ = now.services;
    rememberParameters();
  }
  answered_ = true;
  reportRivals(now);
  reportClocks(now);
}

MasterWatch::Registered MasterWatch::registered(XmlRpc::XmlRpcValue& state) const {
  Registered r;
  const std::string& self = ros::this_node::getName();
  const std::string twin = twinNamespace() + "/";
  // [publishers, subscribers, services], each [[name, [node, ...]], ...].
  XmlRpc::XmlRpcValue& publishers = state[0];
  for (int i = 0; i < publishers.size(); ++i) {
    const std::string topic = publishers[i][0];
    for (int k = 0; k < publishers[i][1].size(); ++k) {
      const std::string node = publishers[i][1][k];
      if (topic == "/clock") {
        r.clocks.insert(node);
      }
      if (node == self) {
        r.topics.insert(topic);
      } else if (topic.compare(0, twin.size(), twin) == 0) {
        r.other_publishers[topic].insert(node);
      }
    }
  }
  XmlRpc::XmlRpcValue& services = state[2];
  for (int i = 0; i < services.size(); ++i) {
    for (int k = 0; k < services[i][1].size(); ++k) {
      if (std::string(services[i][1][k]) == self) {
        r.services.insert(services[i][0]);
      }
    }
  }
  return r;
}

/// Copies this node's parameters on the master while it is registered there.
void MasterWatch::rememberParameters() {
  for (const std::string& name : parameter_names_) {
    XmlRpc::XmlRpcValue value;
    if (ask("getParam", {name}, value)) {
      parameters_[name] = value;
    }
  }
  if (const auto own = parameters_.find(ros::this_node::getName()); own != parameters_.end()) {
    const std::lock_guard<std::mutex> lock(mutex_);
    own_parameters_ = own->second;
  }
}

void MasterWatch::tellAll() const {
  const std::string& self = ros::XMLRPCManager::instance()->getServerURI();
  XmlRpc::XmlRpcValue answer;
  for (const auto& [name, value] : parameters_) {
    bool there = false;
    if (ask("hasParam", {name}, answer)) {
      there = bool(answer);
    }
    if (!there) {
      XmlRpc::XmlRpcValue request;
      XmlRpc::XmlRpcValue response;
      request[0] = ros::this_node::getName();
      request[1] = name;
      request[2] = value;
      ros::master::execute("setParam", request, response, answer, false);
    }
  }
  std::vector<std::string> topics;
  ros::this_node::getAdvertisedTopics(topics);
  for (const std::string& topic : topics) {
    const ros::PublicationPtr publication = ros::TopicManager::instance()->lookupPublication(topic);
    if (publication) {
      ask("registerPublisher", {topic, publication->getDataType(), self}, answer);
    }
  }
  const std::string service_uri = fmt::format("rosrpc://{}:{}", ros::network::getHost(),
                                              ros::ConnectionManager::instance()->getTCPPort());
  for (const std::string& service : services_) {
    ask("registerService", {service, service_uri, self}, answer);
  }
  ros::this_node::getSubscribedTopics(topics);
  for (const std::string& topic : topics) {
    if (ask("registerSubscriber", {topic, "*", self}, answer)) {
      connectTo(topic, answer);
    }
  }
}

/// Other publishers of the topics that this node publishes for the twin.
void MasterWatch::reportRivals(const Registered& now) {
  std::set<std::string> rivals;
  std::string example;
  for (const auto& [topic, nodes] : now.other_publishers) {
    if (now.topics.count(topic) > 0) {
      rivals.insert(nodes.begin(), nodes.end());
      example = topic;
    }
  }
  std::string trouble;
  if (!rivals.empty()) {
    trouble = fmt::format(
        "duplicate publisher: {} publishes on topics of this node, such as {}: two twins in one "
        "namespace",
        printable(fmt::format("{}", fmt::join(rivals, ", ")), kMaxTrouble), printable(example));
    if (rivals != rivals_) {
      ROS_ERROR("%s; start one of them in another namespace", trouble.c_str());
    }
  }
  rivals_ = rivals;
  const std::lock_guard<std::mutex> lock(mutex_);
  trouble_ = trouble;
}

void MasterWatch::reportClocks(const Registered& now) {
  constexpr int kPatience = 2;  // polls: a clock may start a moment after the node
  std::string trouble;
  looks_without_clock_ =
      ros::Time::isSimTime() && now.clocks.empty() ? looks_without_clock_ + 1 : 0;
  if (looks_without_clock_ >= kPatience) {
    trouble =
        "/use_sim_time is set without a publisher of /clock: stamps are wall-clock time (rosparam "
        "delete /use_sim_time, or clock:=true)";
  } else if (now.clocks.size() > 1) {
    trouble = fmt::format("/clock must have one publisher, found {}: time jumps back and forth",
                          fmt::join(now.clocks, " and "));
  }
  const std::lock_guard<std::mutex> lock(mutex_);
  if (!trouble.empty() && trouble != clock_trouble_) {
    ROS_WARN("%s", trouble.c_str());
  }
  clock_trouble_ = trouble;
}

}  // namespace whirl_twin
