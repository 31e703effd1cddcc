#include "transport/payload_layout.h"

#include <fmt/format.h>

#include <algorithm>

namespace whirl_twin {
namespace {

constexpr std::size_t kFingerprintSize = 8;

class PayloadWalk {
 public:
  PayloadWalk(const void* data, std::size_t size)
      : data_(static_cast<const std::uint8_t*>(data)), size_(size) {}

  void skip(std::size_t bytes) {
    if (bytes > size_ - at_) {
      throw RejectedMessage(
          fmt::format("payload: expected {} more bytes at byte {} of {}, found {}", bytes, at_,
                      size_, size_ - at_));
    }
    at_ += bytes;
  }

  /// The length of an array whose elements take at least 4 bytes each.
  std::size_t arrayLength() {
    const std::int64_t length = readLength();
    if (length < 0 || static_cast<std::size_t>(length) > (size_ - at_) / 4) {
      throw RejectedMessage(
          fmt::format("payload: an array of {} entries with {} bytes left", length, size_ - at_));
    }
    return static_cast<std::size_t>(length);
  }

  /// The length of a string includes its terminating zero; a zero inside would truncate it.
  void skipString() {
    const std::int64_t length = readLength();
    if (length < 1 || static_cast<std::size_t>(length) > size_ - at_) {
      throw RejectedMessage(
          fmt::format("payload: a string of {} bytes with {} bytes left", length, size_ - at_));
    }
    const auto* const begin = data_ + at_;
    skip(static_cast<std::size_t>(length));
    if (std::find(begin, data_ + at_, 0) != data_ + at_ - 1) {
      throw RejectedMessage(fmt::format("payload: a string not terminated at byte {}", at_ - 1));
    }
  }

  void requireEnd() const {
    if (at_ != size_) {
      throw RejectedMessage(fmt::format("payload: expected {} bytes, found {}", at_, size_));
    }
  }

 private:
  std::int64_t readLength() {
    skip(4);
    const std::uint8_t* p = data_ + at_ - 4;
    return static_cast<std::int32_t>(std::uint32_t{p[0]} << 24 | std::uint32_t{p[1]} << 16 |
                                     std::uint32_t{p[2]} << 8 | std::uint32_t{p[3]});
  }

  const std::uint8_t* data_;
  std::size_t size_;
  std::size_t at_ = 0;
};

}  // namespace

bool hasFingerprint(std::uint64_t expected, const void* data, std::size_t size) {
  const auto* bytes = static_cast<const std::uint8_t*>(data);
  std::uint64_t found = 0;
  for (std::size_t i = 0; i < kFingerprintSize && i < size; ++i) {
    found = found << 8u | bytes[i];
  }
  return size >= kFingerprintSize && found == expected;
}

void requirePayload(std::int64_t fingerprint, const char* name, const std::string& layout,
                    const void* data, std::size_t size) {
  if (size > kMaxLcmPayload) {
    throw RejectedMessage(
        fmt::format("payload: expected at most {} bytes, found {}", kMaxLcmPayload, size));
  }
  if (!hasFingerprint(static_cast<std::uint64_t>(fingerprint), data, size)) {
    throw RejectedMessage(fmt::format("expected the fingerprint of {}, found another type", name));
  }
  requireLayout(layout, data, size);
}

void requireLayout(const std::string& layout, const void* data, std::size_t size) {
  PayloadWalk walk(data, size);
  walk.skip(kFingerprintSize);
  std::size_t length = 0;
  for (const char field : layout) {
    switch (field) {
      case 'l':
      case 'd':
        walk.skip(8);
        break;
      case 'i':
        walk.skip(4);
        break;
      case 'b':
        walk.skip(1);
        break;
      case 's':
        walk.skipString();
        break;
      case 'n':
        length = walk.arrayLength();
        break;
      case 'S':
        for (std::size_t i = 0; i < length; ++i) {
          walk.skipString();
        }
        break;
      case 'B':
        walk.skip(length);
        break;
      default:
        walk.skip(8 * length);
    }
  }
  walk.requireEnd();
}

}  // namespace whirl_twin
