// Layouts of the twin's LCM types, and the validation of a payload against one: every length within
// the payload, every string terminated, no bytes left. The fields follow one another without
// padding, big-endian (LCM type specification, "Data encoding").
//
// LCM's generated decoders do not check the lengths they read, and its typed subscriptions call
// them: only decodePayload() may (tests/project/check_decoders).
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "messages/message_check.h"
#include "transport/lcm_converters.h"

namespace whirl_twin {

/// Writes one character per field, in the order of the .lcm file:
///   l int64, d double, i int32, b int8 or boolean, s string,
///   n int32 that is the length of the arrays that follow, S array of strings, D of doubles or
///   int64, B of int8.
template <class State>
class LayoutVisit : public FieldVisit<LayoutVisit<State>> {
 public:
  const std::string& layout() const { return layout_; }

  void head() { layout_ += "llld"; }
  template <class F>
  void head(F) {
    layout_ += "lllsd";
  }
  template <class F>
  void sampled(F) {
    layout_ += "lsld";
  }
  void stamped() { layout_ += "ll"; }
  template <class F, class Check>
  void value(F field, const char*, Check, Stays) {
    add(field.in(message_));
  }
  template <class L, class F>
  void length(L, F) {
    layout_ += 'n';
  }
  template <class L, class F>
  void rows(L, F field) {
    using Rows = std::decay_t<decltype(field.of(std::declval<State&>()))>;
    layout_ += 'n';
    Rows::value_type::fields(*this);
  }
  template <class F, class Of>
  void derived(F field, Of) {
    add(field.in(message_));
  }

 private:
  void add(std::int64_t) { layout_ += 'l'; }
  void add(double) { layout_ += 'd'; }
  void add(std::int32_t) { layout_ += 'i'; }
  void add(std::int8_t) { layout_ += 'b'; }
  void add(const std::string&) { layout_ += 's'; }
  void add(const std::vector<std::string>&) { layout_ += 'S'; }
  void add(const std::vector<double>&) { layout_ += 'D'; }
  void add(const std::vector<std::int64_t>&) { layout_ += 'D'; }
  void add(const std::vector<std::int8_t>&) { layout_ += 'B'; }

  LcmType<State> message_{};
  std::string layout_;
};

template <class State>
const std::string& layoutOf() {
  static const std::string layout = [] {
    LayoutVisit<State> visit;
    State::fields(visit);
    return visit.layout();
  }();
  return layout;
}

/// [bytes] Longer payloads are rejected: the longest message of a twin has some megabytes.
inline constexpr std::size_t kMaxLcmPayload = std::size_t{1} << 24u;

bool hasFingerprint(std::uint64_t expected, const void* data, std::size_t size);

/// Throws RejectedMessage unless the fields of `layout` fill data[0..size) exactly, after the
/// fingerprint [8 bytes].
void requireLayout(const std::string& layout, const void* data, std::size_t size);

/// Throws RejectedMessage unless the payload is no longer than kMaxLcmPayload, begins with the
/// fingerprint of the type called `name`, and has its layout.
void requirePayload(std::int64_t fingerprint, const char* name, const std::string& layout,
                    const void* data, std::size_t size);

/// Decodes a payload of this layout. Throws RejectedMessage if it has another.
template <class Type>
Type decodePayload(const std::string& layout, const void* data, std::size_t size) {
  requirePayload(Type::getHash(), Type::getTypeName(), layout, data, size);
  Type message;
  if (message.decode(data, 0, static_cast<int>(size)) != static_cast<int>(size)) {
    throw RejectedMessage(std::string("payload: not a ") + Type::getTypeName());
  }
  return message;
}

}  // namespace whirl_twin
