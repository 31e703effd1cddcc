// The state of what steps as bytes: taken from it, or put back into another that was made alike. A
// class goes through what changes in it once, for both ways,
//
//   void exchange(StateImage& image) noexcept { image(state_, errors_, method_); }
//
// so that what is put back is what was taken. What is plain, which owns nothing and refers to
// nothing, goes as a whole, and no member of it can be forgotten. Real-time safe.
//
// A file may say anything: after exchange() a class requires of what was put back what it never
// violates itself, above all that places lie within what they are places of.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>
#include <utility>
#include <vector>

namespace whirl_twin {

class StateImage;

/// Goes through its members itself.
template <class Part, class = void>
struct Exchanges : std::false_type {};
template <class Part>
struct Exchanges<Part,
                 std::void_t<decltype(std::declval<Part&>().exchange(std::declval<StateImage&>()))>>
    : std::true_type {};

/// Of Eigen: its numbers may lie elsewhere.
template <class Part, class = void>
struct IsMatrix : std::false_type {};
template <class Part>
struct IsMatrix<Part, std::void_t<typename Part::Scalar>> : std::true_type {};

class StateImage {
 public:
  /// Takes a state. What finds no room is counted, so that without any it tells the size().
  static StateImage taking(char* room, std::size_t size) noexcept { return {room, nullptr, size}; }
  /// Puts one back. Where it is of something made otherwise it is not sound(), and what was put
  /// back of it means nothing.
  static StateImage putting(const char* image, std::size_t size) noexcept {
    return {nullptr, image, size};
  }

  bool puts() const noexcept { return from_ != nullptr; }
  std::size_t size() const noexcept { return done_; }  ///< [bytes], so far
  /// Taken: it had room, and everything in it can be taken. Put back: it was all there.
  bool sound() const noexcept { return sound_ && done_ <= size_; }
  /// Something of unknown insides is in it.
  void refuse() noexcept { sound_ = false; }
  /// Of what was put back: it holds, or the image is not sound(). False: it does not, and the
  /// caller must not use it.
  bool require(bool holds) noexcept {
    sound_ = sound_ && (holds || !puts());
    return holds || !puts();
  }
  /// The same of a number that is to be from `least` to `most`, which it is made to be.
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

  /// With their number before them, by which another layout is known.
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
