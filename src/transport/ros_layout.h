// Deserializes ROS messages by the definition in the bag: bags are read without ROS, and old bags
// by their own definitions.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace whirl_twin {

/// The value of a field: one entry unless it is an array.
struct RosValue {
  std::vector<std::int64_t> whole;  ///< integers, bool; times and durations [ns]
  std::vector<double> real;         ///< float32 and float64
  std::vector<std::string> text;
};

/// By name; nested fields as "header.stamp", those of an array of messages concatenated.
using RosValues = std::map<std::string, RosValue, std::less<>>;

class RosLayout {
 public:
  /// From the definition of a message: its .msg file, and after lines of '=' and `MSG:
  /// package/Name` those it includes. Throws RejectedMessage for an invalid definition.
  explicit RosLayout(const std::string& definition);

  /// A field with the name that read() gives it; is_array: it is an array or part of one.
  struct Name {
    std::string name;
    bool is_array;
  };
  /// All fields in the order of the definition.
  std::vector<Name> names() const;

  /// Throws RejectedMessage for bytes that do not match the definition exactly.
  RosValues read(const std::uint8_t* data, std::size_t size) const;

 private:
  enum class Kind { kSigned, kUnsigned, kReal, kText, kTime, kDuration, kMessage };
  struct Field {
    std::string name;  ///< with the names of the enclosing fields
    Kind kind = Kind::kSigned;
    std::size_t width = 0;  ///< [bytes], of a number
    bool is_array = false;
    std::size_t count = 0;        ///< of an array; 0: preceded by its length
    std::vector<Field> fields{};  ///< of a kMessage
    std::size_t least = 0;        ///< [bytes], smallest size of an entry
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
