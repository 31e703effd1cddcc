#include "transport/ros2_message.h"

#include <algorithm>
#include <map>
#include <sstream>
#include <string_view>

namespace whirl_twin {

namespace {

/// Writes numbers at multiples of their widths, counted from the end of the encapsulation header.
class CdrVisitor final : public RosVisitor {
 public:
  explicit CdrVisitor(LittleEndian& out) : out_(out) {
    out_.clear();
    out_.bytes(std::string_view{"\0\1\0\0", kHeader});  // CDR, little-endian; no options
  }

  void begin(const RosField& field, std::size_t count) override {
    if (field.is_array && field.count == 0) {
      put(count, 4);
    }
    if (field.kind == RosField::Kind::kMessage && field.fields.empty()) {
      put(0, 1);  // structure_needs_at_least_one_member
    }
  }
  void number(const RosField& field, std::uint64_t bits) override {
    if (field.only_ros1) {
      return;
    }
    if (field.kind == RosField::Kind::kTime || field.kind == RosField::Kind::kDuration) {
      put(bits & 0xffffffff, 4);
      put(bits >> 32, 4);
    } else {
      put(bits, field.width);
    }
  }
  void text(const RosField&, std::string_view text) override {
    put(text.size() + 1, 4);
    out_.bytes(text);
    out_.number(0, 1);
  }

 private:
  static constexpr std::size_t kHeader = 4;  // bytes

  void put(std::uint64_t value, std::size_t width) {
    while ((out_.size() - kHeader) % width != 0) {
      out_.number(0, 1);
    }
    out_.number(value, static_cast<int>(width));
  }

  LittleEndian& out_;
};

constexpr const char* kRos2Separator =
    "================================================================================\n";

/// A line of a definition with the type as ROS 2 names it.
std::string ros2Line(const std::string& line) {
  static const std::map<std::string, std::string, std::less<>> kTypes = {
      {"Header", "std_msgs/Header"},
      {"time", "builtin_interfaces/Time"},
      {"duration", "builtin_interfaces/Duration"},
      {"byte", "int8"},
      {"char", "uint8"}};
  const std::size_t begin = std::min(line.find_first_not_of(" \t"), line.size());
  const std::size_t end = std::min(line.find_first_of(" \t[", begin), line.size());
  const auto type = kTypes.find(line.substr(begin, end - begin));
  return type == kTypes.end() ? line : type->second + line.substr(end);
}

std::string ros2Definition(const std::string& definition) {
  std::istringstream lines(definition);
  std::string out, line;
  bool in_header = false;
  while (std::getline(lines, line)) {
    if (line.rfind("MSG:", 0) == 0) {
      in_header = line == "MSG: std_msgs/Header";
    }
    if (!in_header || line != "uint32 seq") {
      out += ros2Line(line) + "\n";
    }
  }
  for (const char* name : {"Time", "Duration"}) {
    const std::string full = std::string("builtin_interfaces/") + name;
    if (out.find(full) != std::string::npos) {
      out += kRos2Separator + ("MSG: " + full) + "\nint32 sec\nuint32 nanosec\n";
    }
  }
  return out;
}

}  // namespace

std::string ros2TypeName(const std::string& type) {
  const std::size_t bar = type.find('/');
  return bar == std::string::npos ? type : type.substr(0, bar) + "/msg" + type.substr(bar);
}

Ros2Message::Ros2Message(const std::string& definition)
    : layout_(definition), definition_(ros2Definition(definition)) {}

const LittleEndian& Ros2Message::convert(const std::uint8_t* data, std::size_t size) {
  CdrVisitor visitor(bytes_);
  layout_.visit(data, size, visitor);
  return bytes_;
}

}  // namespace whirl_twin
