// Where a rotor whirls, ten times a second, from ROS: its speed, its radius, its lag behind the
// unbalance. whirl_by_ros SYSTEM, its name in the scene.
#include <ros/ros.h>
#include <whirl_twin/WhirlState.h>

#include <cstdio>
#include <string>

constexpr int kEvery = 100;  // steps
constexpr double kDegrees = 57.29577951308232;

void show(const whirl_twin::WhirlState& state) {
  if (state.step % kEvery != 0) {
    return;
  }
  std::printf("%.3f s  %.3f rad/s  %.5f mm  ", state.time, state.speed, 1e3 * state.radius);
  state.phase_valid ? std::printf("%.2f deg\n", kDegrees * state.phase) : std::printf("- deg\n");
  std::fflush(stdout);
}

int main(int argc, char** argv) {
  ros::init(argc, argv, "whirl_by_ros", ros::init_options::AnonymousName);
  if (argc != 2) {
    std::fputs("usage: whirl_by_ros SYSTEM\n", stderr);
    return 2;
  }
  ros::NodeHandle node;
  const std::string topic = "/twin/" + std::string(argv[1]) + "/whirl";
  const auto states = node.subscribe(topic, 1000, show, ros::TransportHints().tcpNoDelay());
  ros::spin();
}
