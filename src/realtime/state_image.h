// Serialization of a stepping object's state to bytes, and restoration into another object made
// with the same parameters. A class lists its variable members once, for both directions,
//
//   void exchange(StateImage& image) noexcept { image(state_, errors_, method_); }
//
// so that the restored members are the saved ones. A trivially copyable object without pointers is
// copied as a whole, so no part of it can be omitted. Real-time safe.
//
// A file may contain anything: after exchange() a class checks its own invariants on the restored
// values, above all that indices are in range.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>
#include <utility>
#include <vector>

namespace whirl_twin {

class StateImage;

/// Detects a class with its own exchange().
template <class Part, class = void>
struct Exchanges : std::false_type {};
template <class Part>
struct Exchanges<Part,
                 std::void_t<decltype(std::declval<Part&>().exchange(std::declval<StateImage&>()))>>
    : std::true_type {};

/// Detects Eigen types, whose numbers may be on the heap.
template <class Part, class = void>
struct IsMatrix : std::false_type {};
template <class Part>
struct IsMatrix<Part, std::void_t<typename Part::Scalar>> : std::true_type {};

class StateImage {
 public:
  /// Saves a state. Bytes beyond `size` are only counted, so size 0 yields the required size().
  static StateImage taking(char* room, std::size_t size) noexcept { return {room, nullptr, size}; }
  /// Restores a state. If the image is of an object made differently, it is not sound(), and the
  /// restored values are meaningless.
  static StateImage putting(const char* image, std::size_t size) noexcept {
    return {nullptr, image, size};
  }

  bool puts() const noexcept { return from_ != nullptr; }
  std::size_t size() const noexcept { return done_; }  ///< [bytes], so far
  /// Saved: it fitted, and everything in it can be saved. Restored: it was complete.
  bool sound() const noexcept { return sound_ && done_ <= size_; }
  /// Marks the image as not sound(): it contains an object of unknown structure.
  void refuse() noexcept { sound_ = false; }
  /// Check of a restored value: if `holds` is false, the image is not sound(), the result is false,
  /// and the caller must not use the value.
  bool require(bool holds) noexcept {
    sound_ = sound_ && (holds || !puts());
    return holds || !puts();
  }
  /// The same for a number, which must be from `least` to `most`, and is set to `least` otherwise.
  template <class Number>
  void requireWithin(Number& number, Number least, Number most) noexcept {
    if (!require(number >= least && number <= most)) {
      number = least;
    }
  }

  template <class... Parts>
  void operator()(Parts&... parts) noexcept {
    (part(parts), ...);
  }
  /// A whole object, also of a class that exchanges its members.
  template <class Plain>
  void whole(Plain& plain) noexcept {
    static_assert(std::is_trivially_destructible_v<Plain> && !std::is_polymorphic_v<Plain> &&
                      !std::is_pointer_v<Plain>,
                  "this owns something: it has to exchange() its members");
    bytes(&plain, sizeof plain);
  }

 private:
  StateImage(char* to, const char* from, std::size_t size) noexcept
      : to_(to), from_(from), size_(size) {}

  template <class Part>
  void part(Part& one) noexcept {
    if constexpr (Exchanges<Part>::value) {
      one.exchange(*this);
    } else if constexpr (std::is_same_v<Part, bool>) {
      auto byte = static_cast<unsigned char>(one ? 1 : 0);
      whole(byte);
      one = byte == 1;
      require(byte <= 1);
    } else if constexpr (IsMatrix<Part>::value) {
      bytes(one.data(), static_cast<std::size_t>(one.size()) * sizeof(*one.data()));
    } else {
      whole(one);
    }
  }
  template <class Part, class Allocator>
  void part(std::vector<Part, Allocator>& parts) noexcept {
    if constexpr (Exchanges<Part>::value) {
      for (Part& each : parts) {
        part(each);
      }
    } else {
      static_assert(std::is_trivially_destructible_v<Part> && !std::is_pointer_v<Part>);
      bytes(parts.data(), parts.size() * sizeof(Part));
    }
  }

  /// Preceded by their number, which detects a different layout.
  void bytes(void* data, std::uint64_t count) noexcept {
    if (from_ == nullptr) {
      take(&count, sizeof count);
      take(data, count);
      return;
    }
    std::uint64_t found = 0;
    put(&found, sizeof found);
    if (found != count) {
      sound_ = false;
    }
    put(data, count);
  }
  void take(const void* data, std::size_t count) noexcept {
    if (done_ + count <= size_ && count > 0) {
      std::memcpy(to_ + done_, data, count);
    }
    done_ += count;
  }
  void put(void* data, std::size_t count) noexcept {
    if (!sound_ || count > size_ - done_) {
      sound_ = false;
      return;
    }
    if (count > 0) {
      std::memcpy(data, from_ + done_, count);
    }
    done_ += count;
  }

  char* to_;
  const char* from_;
  std::size_t size_;
  std::size_t done_ = 0;
  bool sound_ = true;
};

}  // namespace whirl_twin
