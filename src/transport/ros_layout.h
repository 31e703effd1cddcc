// How a ROS message lies in bytes, by the definition that a bag has of it: so that a bag is read
// without ROS, and one of last year by the definition of last year.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace whirl_twin {

/// What a field has, one entry of those that are no array.
struct RosValue {
  std::vector<std::int64_t> whole;  ///< of integers and bool; of times and durations [ns]
  std::vector<double> real;         ///< of float32 and float64
  std::vector<std::string> text;
};

/// By name; fields of a field as "header.stamp", of an array of messages one after another.
using RosValues = std::map<std::string, RosValue, std::less<>>;

class RosLayout {
 public:
  /// Of a message's definition: its .msg file, and after lines of '=' and `MSG: package/Name` those
  /// that it names. Throws RejectedMessage for what is no definition.
  explicit RosLayout(const std::string& definition);

  /// A field as `read` names it; is_array: or part of one.
  struct Name {
    std::string name;
    bool is_array;
  };
  /// All fields in the order of the definition.
  std::vector<Name> names() const;

  /// Throws RejectedMessage for bytes that are no such message, or no whole one.
  RosValues read(const std::uint8_t* data, std::size_t size) const;

 private:
  enum class Kind { kSigned, kUnsigned, kReal, kText, kTime, kDuration, kMessage };
  struct Field {
    std::string name;  ///< with those of what it is part of
    Kind kind = Kind::kSigned;
    std::size_t width = 0;  ///< [bytes], of a number
    bool is_array = false;
    std::size_t count = 0;        ///< of an array: 0 says that its length stands before it
    std::vector<Field> fields{};  ///< of a kMessage
    std::size_t least = 0;        ///< [bytes], that an entry takes
  };
  using Types = std::map<std::string, std::string, std::less<>>;  ///< text by name
  class Reader;

  static std::vector<Field> fieldsOf(std::string_view text, const std::string& package,
                                     const std::string& prefix, const Types& types, int depth);
  static std::size_t leastOf(const std::vector<Field>& fields);
  static void addNames(const std::vector<Field>& fields, bool in_array, std::vector<Name>& names);

  std::vector<Field> fields_;
};

}  // namespace whirl_twin
