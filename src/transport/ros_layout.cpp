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
      types[name];  // it may have no fields
      begins = false;
    } else {
      types[name].append(line).push_back('\n');
    }
  });
  fields_ = fieldsOf(types[""], "", "", types, 0);
}

std::vector<RosField> RosLayout::fieldsOf(std::string_view text, const std::string& package,
                                          const std::string& prefix, const Types& types,
                                          int depth) {
  static const std::map<std::string_view, std::pair<RosField::Kind, std::size_t>> kNumbers = {
      {"bool", {RosField::Kind::kUnsigned, 1}},     {"byte", {RosField::Kind::kSigned, 1}},
      {"char", {RosField::Kind::kUnsigned, 1}},     {"int8", {RosField::Kind::kSigned, 1}},
      {"uint8", {RosField::Kind::kUnsigned, 1}},    {"int16", {RosField::Kind::kSigned, 2}},
      {"uint16", {RosField::Kind::kUnsigned, 2}},   {"int32", {RosField::Kind::kSigned, 4}},
      {"uint32", {RosField::Kind::kUnsigned, 4}},   {"int64", {RosField::Kind::kSigned, 8}},
      {"uint64", {RosField::Kind::kUnsigned, 8}},   {"float32", {RosField::Kind::kReal, 4}},
      {"float64", {RosField::Kind::kReal, 8}},      {"time", {RosField::Kind::kTime, 8}},
      {"duration", {RosField::Kind::kDuration, 8}}, {"string", {RosField::Kind::kText, 4}}};
  if (depth > kDeepestMessage) {
    throw RejectedMessage(
        fmt::format("definition: must be nested at most {} messages deep", kDeepestMessage));
  }
  std::vector<RosField> fields;
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
    RosField field;
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
      field.kind = RosField::Kind::kMessage;
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
      if (found->first == "std_msgs/Header" && !field.fields.empty()) {
        field.fields.front().only_ros1 = true;
      }
    }
    if (field.is_array && field.least == 0) {
      throw RejectedMessage("definition: an array without a type: " + printable(std::string(line)));
    }
    fields.push_back(std::move(field));
  });
  return fields;
}

/// [bytes], the smallest size of a message with these fields, limited to kMaxArray.
std::size_t RosLayout::leastOf(const std::vector<RosField>& fields) {
  std::size_t least = 0;
  for (const RosField& field : fields) {
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

void RosLayout::addNames(const std::vector<RosField>& fields, bool in_array,
                         std::vector<Name>& names) {
  for (const RosField& field : fields) {
    if (field.kind == RosField::Kind::kMessage) {
      addNames(field.fields, in_array || field.is_array, names);
    } else {
      names.push_back({field.name, in_array || field.is_array});
    }
  }
}

class RosLayout::Reader {
 public:
  Reader(const std::uint8_t* data, std::size_t size, RosVisitor& visitor)
      : data_(data), left_(size), visitor_(visitor) {}

  void read(const std::vector<RosField>& fields) {
    for (const RosField& field : fields) {
      std::size_t count = 1;
      if (field.is_array) {
        count = field.count > 0 ? field.count : littleEndianOf(bytes(4, field), 4);
        if (count > left_ / field.least) {
          throw tooShort(field);
        }
      }
      visitor_.begin(field, count);
      for (std::size_t i = 0; i < count; ++i) {
        if (field.kind == RosField::Kind::kMessage) {
          read(field.fields);
        } else {
          readOne(field);
        }
      }
    }
  }
  std::size_t left() const { return left_; }

 private:
  void readOne(const RosField& field) {
    const std::uint64_t bits = littleEndianOf(bytes(field.width, field), field.width);
    if (field.kind == RosField::Kind::kText) {
      visitor_.text(field, {reinterpret_cast<const char*>(bytes(bits, field)), bits});
    } else {
      visitor_.number(field, bits);
    }
  }
  const std::uint8_t* bytes(std::size_t count, const RosField& field) {
    if (count > left_) {
      throw tooShort(field);
    }
    const std::uint8_t* const here = data_;
    data_ += count;
    left_ -= count;
    return here;
  }
  static RejectedMessage tooShort(const RosField& field) {
    return RejectedMessage(field.name + ": missing, the message is too short");
  }

  const std::uint8_t* data_;
  std::size_t left_;
  RosVisitor& visitor_;
};

void RosLayout::visit(const std::uint8_t* data, std::size_t size, RosVisitor& visitor) const {
  Reader reader(data, size, visitor);
  reader.read(fields_);
  if (reader.left() > 0) {
    throw RejectedMessage(fmt::format("payload: {} bytes too many", reader.left()));
  }
}

namespace {

class ValueVisitor final : public RosVisitor {
 public:
  explicit ValueVisitor(RosValues& values) : values_(values) {}

  void begin(const RosField& field, std::size_t) override { value_ = &values_[field.name]; }
  void number(const RosField& field, std::uint64_t bits) override {
    switch (field.kind) {
      case RosField::Kind::kSigned:
        value_->whole.push_back(signedOf(bits, field.width));
        break;
      case RosField::Kind::kReal:
        value_->real.push_back(realOf(bits, field.width));
        break;
      case RosField::Kind::kTime:
      case RosField::Kind::kDuration: {
        constexpr std::int64_t kSecond = 1'000'000'000;  // ns
        const bool is_time = field.kind == RosField::Kind::kTime;
        const auto low = static_cast<std::int64_t>(bits & 0xffffffff);
        const auto high = static_cast<std::int64_t>(bits >> 32);
        value_->whole.push_back((is_time ? low : signedOf(bits & 0xffffffff, 4)) * kSecond +
                                (is_time ? high : signedOf(bits >> 32, 4)));
        break;
      }
      default:
        value_->whole.push_back(static_cast<std::int64_t>(bits));
    }
  }
  void text(const RosField&, std::string_view text) override { value_->text.emplace_back(text); }

 private:
  RosValues& values_;
  RosValue* value_ = nullptr;
};

}  // namespace

RosValues RosLayout::read(const std::uint8_t* data, std::size_t size) const {
  RosValues values;
  ValueVisitor visitor(values);
  visit(data, size, visitor);
  return values;
}

}  // namespace whirl_twin
