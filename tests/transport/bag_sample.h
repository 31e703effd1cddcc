// Bags in the format of rosbag (2.0), in temporary files of a test, with messages serialized by ROS
// itself.
#pragma once

#include <ros/serialization.h>
#include <sensor_msgs/JointState.h>

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "event_log_sample.h"
#include "transport/ros_converters.h"

namespace whirl_twin {

/// A bag with one chunk, not compressed.
class BagSample {
 public:
  template <class Message>
  void write(const std::string& topic, std::int64_t time, const Message& message) {
    const auto [connection, is_new] = connections_.try_emplace(topic, connections_.size());
    const std::string conn = "conn=" + little(connection->second, 4);
    if (is_new) {
      const std::string data = fields(
          {"topic=" + topic, std::string("type=") + ros::message_traits::DataType<Message>::value(),
           std::string("md5sum=") + ros::message_traits::MD5Sum<Message>::value(),
           std::string("message_definition=") + ros::message_traits::Definition<Message>::value()});
      chunk_ += record({conn, op(7), "topic=" + topic}, data);
    }
    std::string data(ros::serialization::serializationLength(message), '\0');
    ros::serialization::OStream stream(reinterpret_cast<std::uint8_t*>(data.data()),
                                       static_cast<std::uint32_t>(data.size()));
    ros::serialization::serialize(stream, message);
    const auto seconds = static_cast<std::uint64_t>(time / 1'000'000'000);
    chunk_ += record({conn, op(2),
                      "time=" + little(seconds, 4) +
                          little(static_cast<std::uint64_t>(time % 1'000'000'000), 4)},
                     data);
  }

  /// complete: else as an aborted recording, whose chunk is marked as empty.
  Bytes bytes(bool complete = true) const {
    std::string bag =
        "#ROSBAG V2.0\n" + record({op(3), "index_pos=" + little(0, 8), "conn_count=" + little(0, 4),
                                   "chunk_count=" + little(0, 4)},
                                  std::string(4027, ' '));
    const std::vector<std::string> header = {"compression=none", op(5),
                                             "size=" + little(complete ? chunk_.size() : 0, 4)};
    bag += complete ? record(header, chunk_) : record(header, "") + chunk_;
    return {bag.begin(), bag.end()};
  }

 private:
  static std::string little(std::uint64_t number, int bytes) {
    std::string out;
    for (int i = 0; i < bytes; ++i) {
      out.push_back(static_cast<char>(number >> 8 * i & 0xff));
    }
    return out;
  }
  static std::string op(char code) { return std::string("op=") + code; }
  static std::string fields(const std::vector<std::string>& all) {
    std::string out;
    for (const std::string& field : all) {
      out += little(field.size(), 4) + field;
    }
    return out;
  }
  static std::string record(const std::vector<std::string>& header, const std::string& data) {
    const std::string head = fields(header);
    return little(head.size(), 4) + head + little(data.size(), 4) + data;
  }

  std::map<std::string, std::uint64_t> connections_;
  std::string chunk_;
};

}  // namespace whirl_twin
