#include "transport/ros_layout.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstring>
#include <tuple>
#include <utility>

#include "messages/message_check.h"
#include "messages/names.h"

namespace whirl_twin {
namespace {

constexpr int kDeepestMessage = 8;          // levels of nested messages
constexpr std::size_t kMaxFields = 1000;    // of a message
constexpr std::size_t kMaxArray = 1 << 20;  // entries, of one whose length is fixed
constexpr std::string_view kSeparator = "====";

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t\r");
  return first == std::string_view::npos
             ? std::string_view()
             : text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

/// Calls take(line) for each line, without surrounding white space.
template <class Take>
void eachLine(std::string_view text, Take&& take) {
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    take(trimmed(text.substr(0, end)));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
}

std::uint64_t littleEndianOf(const std::uint8_t* bytes, std::size_t width) {
  std::uint64_t number = 0;
  for (std::size_t i = width; i > 0; --i) {
    number = number << 8 | bytes[i - 1];
  }
  return number;
}

/// A two's-complement integer of `width` bytes.
std::int64_t signedOf(std::uint64_t bits, std::size_t width) {
  const std::size_t spare = 64 - 8 * width;
  return static_cast<std::int64_t>(bits << spare) >> spare;
}

double realOf(std::uint64_t bits, std::size_t width) {
  if (width == sizeof(double)) {
    double real = 0.0;
    std::memcpy(&real, &bits, sizeof real);
    return real;
  }
  const auto half = static_cast<std::uint32_t>(bits);
  float real = 0.0F;
  std::memcpy(&real, &half, sizeof real);
  return static_cast<double>(real);
}

}  // namespace

RosLayout::RosLayout(const std::string& definition) {
  Types types;
  std::string name;  // of the message itself: empty
  bool begins = false;
  eachLine(definition, [&](std::string_view line) {
    if (line.substr(0, kSeparator.size()) == kSeparator) {
      begins = true;
    } else if (begins && line.substr(0, 4) == "MSG:") {
      name = trimmed(line.substr(4));
      begins = false;
    } else {
      types[name].append(line).push_back('\n');
    }
  });
  fields_ = fieldsOf(types[""], "", "", types, 0);
}

std::vector<RosLayout::Field> RosLayout::fieldsOf(std::string_view text, const std::string& package,
                                                  const std::string& prefix, const Types& types,
                                                  int depth) {
  static const std::map<std::string_view, std::pair<Kind, std::size_t>> kNumbers = {
      {"bool", {Kind::kUnsigned, 1}},     {"byte", {Kind::kSigned, 1}},
      {"char", {Kind::kUnsigned, 1}},     {"int8", {Kind::kSigned, 1}},
      {"uint8", {Kind::kUnsigned, 1}},    {"int16", {Kind::kSigned, 2}},
      {"uint16", {Kind::kUnsigned, 2}},   {"int32", {Kind::kSigned, 4}},
      {"uint32", {Kind::kUnsigned, 4}},   {"int64", {Kind::kSigned, 8}},
      {"uint64", {Kind::kUnsigned, 8}},   {"float32", {Kind::kReal, 4}},
      {"float64", {Kind::kReal, 8}},      {"time", {Kind::kTime, 8}},
      {"duration", {Kind::kDuration, 8}}, {"string", {Kind::kText, 4}}};
  if (depth > kDeepestMessage) {
    throw RejectedMessage(
        fmt::format("definition: must be nested at most {} messages deep", kDeepestMessage));
  }
  std::vector<Field> fields;
  eachLine(text, [&](std::string_view line) {
    const std::size_t type_end = line.find_first_of(" \t");
    if (line.empty() || line.front() == '#') {
      return;
    }
    const std::string_view rest =
        type_end == std::string_view::npos ? "" : trimmed(line.substr(type_end));
    const std::string_view own = trimmed(rest.substr(0, rest.find('#')));
    if (own.find('=') != std::string_view::npos) {
      return;  // a constant
    }
    std::string_view type = line.substr(0, type_end);
    Field field;
    const std::size_t bracket = type.find('[');
    if (bracket != std::string_view::npos) {
      field.is_array = true;
      const std::string_view length = type.substr(bracket + 1, type.size() - bracket - 2);
      const char* const end = length.data() + length.size();
      const auto parsed = std::from_chars(length.data(), end, field.count);
      const bool is_count =
          parsed.ec == std::errc() && parsed.ptr == end && field.count <= kMaxArray;
      if (type.back() != ']' || !(length.empty() || (is_count && field.count > 0))) {
        throw RejectedMessage("definition: an array without a length: " +
                              printable(std::string(line)));
      }
      type = type.substr(0, bracket);
    }
    if (own.empty() || own.find_first_of(" \t") != std::string_view::npos ||
        fields.size() >= kMaxFields) {
      throw RejectedMessage("definition: expected a type and a name, found " +
                            printable(std::string(line)));
    }
    field.name = prefix + std::string(own);
    const auto number = kNumbers.find(type);
    if (number != kNumbers.end()) {
      std::tie(field.kind, field.width) = number->second;
      field.least = field.width;
    } else {
      field.kind = Kind::kMessage;
      std::string full(type == "Header" ? "std_msgs/Header" : type);
      if (full.find('/') == std::string::npos) {
        full = package + full;
      }
      // A message of the same package may be given without the package, which is not known here.
      const auto found = std::find_if(types.begin(), types.end(), [&](const auto& known) {
        const std::string& name = known.first;
        return name == full || (full.find('/') == std::string::npos &&
                                name.substr(name.find('/') + 1) == full && !name.empty());
      });
      if (found == types.end()) {
        throw RejectedMessage("definition: unknown message " + printable(full));
      }
      const std::string of = found->first.substr(0, found->first.find('/') + 1);
      field.fields = fieldsOf(found->second, of, field.name + ".", types, depth + 1);
      field.least = leastOf(field.fields);
    }
    if (field.is_array && field.least == 0) {
      throw RejectedMessage("definition: an array without a type: " + printable(std::string(line)));
    }
    fields.push_back(std::move(field));
  });
  return fields;
}

/// [bytes], the smallest size of a message with these fields, limited to kMaxArray.
std::size_t RosLayout::leastOf(const std::vector<Field>& fields) {
  std::size_t least = 0;
  for (const Field& field : fields) {
    const std::size_t of = !field.is_array   ? field.least
                           : field.count > 0 ? field.count * std::min(field.least, kMaxArray)
                                             : sizeof(std::uint32_t);
    least = std::min(least + of, kMaxArray);
  }
  return least;
}

std::vector<RosLayout::Name> RosLayout::names() const {
  std::vector<Name> names;
  addNames(fields_, false, names);
  return names;
}

void RosLayout::addNames(const std::vector<Field>& fields, bool in_array,
                         std::vector<Name>& names) {
  for (const Field& field : fields) {
    if (field.kind == Kind::kMessage) {
      addNames(field.fields, in_array || field.is_array, names);
    } else {
      names.push_back({field.name, in_array || field.is_array});
    }
  }
}

class RosLayout::Reader {
 public:
  Reader(const std::uint8_t* data, std::size_t size) : data_(data), left_(size) {}

  void take(const std::vector<Field>& fields, RosValues& values) {
    for (const Field& field : fields) {
      std::size_t count = 1;
      if (field.is_array) {
        count = field.count > 0 ? field.count : littleEndianOf(bytes(4, field), 4);
        if (count > left_ / field.least) {
          throw tooShort(field);
        }
      }
      RosValue& value = values[field.name];
      for (std::size_t i = 0; i < count; ++i) {
        if (field.kind == Kind::kMessage) {
          take(field.fields, values);
        } else {
          takeOne(field, value);
        }
      }
    }
  }
  std::size_t left() const { return left_; }

 private:
  void takeOne(const Field& field, RosValue& value) {
    const std::uint64_t bits = littleEndianOf(bytes(field.width, field), field.width);
    switch (field.kind) {
      case Kind::kSigned:
        value.whole.push_back(signedOf(bits, field.width));
        break;
      case Kind::kUnsigned:
        value.whole.push_back(static_cast<std::int64_t>(bits));
        break;
      case Kind::kReal:
        value.real.push_back(realOf(bits, field.width));
        break;
      case Kind::kTime:
      case Kind::kDuration: {
        constexpr std::int64_t kSecond = 1'000'000'000;  // ns
        const bool is_time = field.kind == Kind::kTime;
        const auto low = static_cast<std::int64_t>(bits & 0xffffffff);
        const auto high = static_cast<std::int64_t>(bits >> 32);
        value.whole.push_back((is_time ? low : signedOf(bits & 0xffffffff, 4)) * kSecond +
                              (is_time ? high : signedOf(bits >> 32, 4)));
        break;
      }
      default: {
        const auto* const text = reinterpret_cast<const char*>(bytes(bits, field));
        value.text.emplace_back(text, bits);
      }
    }
  }
  const std::uint8_t* bytes(std::size_t count, const Field& field) {
    if (count > left_) {
      throw tooShort(field);
    }
    const std::uint8_t* const here = data_;
    data_ += count;
    left_ -= count;
    return here;
  }
  static RejectedMessage tooShort(const Field& field) {
    return RejectedMessage(field.name + ": missing, the message is too short");
  }

  const std::uint8_t* data_;
  std::size_t left_;
};

RosValues RosLayout::read(const std::uint8_t* data, std::size_t size) const {
  RosValues values;
  Reader reader(data, size);
  reader.take(fields_, values);
  if (reader.left() > 0) {
    throw RejectedMessage(fmt::format("payload: {} bytes too many", reader.left()));
  }
  return values;
}

}  // namespace whirl_twin
