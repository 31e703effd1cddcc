// One program for all tests of live nodes in C++; live_test.py starts the nodes, and names the
// tests.
#include <gtest/gtest.h>
#include <ros/ros.h>

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "live_tests");
  const ros::NodeHandle node;  // ROS shuts down with the last handle: it outlives the tests
  return RUN_ALL_TESTS();
}
