// Little-endian serialization of ROS messages, rosbags and MCAP files; strings follow their length.
#pragma once

#include <cstdint>
#include <cstring>
#include <string_view>
#include <vector>

namespace whirl_twin {

class LittleEndian {
 public:
  /// The lowest `width` bytes of a number.
  void number(std::uint64_t value, int width) {
    for (int i = 0; i < width; ++i) {
      bytes_.push_back(static_cast<std::uint8_t>(value >> 8 * i));
    }
  }
  void real(double value) {
    std::uint64_t bits = 0;
    std::memcpy(&bits, &value, sizeof bits);
    number(bits, 8);
  }
  void bytes(const void* data, std::size_t size) {
    const auto* const from = static_cast<const std::uint8_t*>(data);
    bytes_.insert(bytes_.end(), from, from + size);
  }
  void bytes(std::string_view text) { bytes(text.data(), text.size()); }
  void bytes(const LittleEndian& other) { bytes(other.data(), other.size()); }
  /// The length in 4 bytes, then the string.
  void text(std::string_view text) {
    number(text.size(), 4);
    bytes(text);
  }
  /// The length in 4 bytes, then the bytes.
  void block(const LittleEndian& other) {
    number(other.size(), 4);
    bytes(other);
  }

  const std::uint8_t* data() const { return bytes_.data(); }
  std::size_t size() const { return bytes_.size(); }
  bool empty() const { return bytes_.empty(); }
  void clear() { bytes_.clear(); }

 private:
  std::vector<std::uint8_t> bytes_;
};

}  // namespace whirl_twin
