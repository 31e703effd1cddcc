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

/// A field of a definition.
struct RosField {
  enum class Kind { kSigned, kUnsigned, kReal, kText, kTime, kDuration, kMessage };
  std::string name;  ///< with the names of the enclosing fields
  Kind kind = Kind::kSigned;
  std::size_t width = 0;  ///< [bytes], of a number
  bool is_array = false;
  std::size_t count = 0;           ///< of an array; 0: preceded by its length
  std::vector<RosField> fields{};  ///< of a kMessage
  std::size_t least = 0;           ///< [bytes], smallest size of an entry
  bool only_ros1 = false;          ///< `seq` of a header, which ROS 2 does not have
};

/// Receives the fields of a message in order.
class RosVisitor {
 public:
  virtual ~RosVisitor() = default;
  /// The entries of a field follow, as many as `count`: one unless it is an array.
  virtual void begin(const RosField& field, std::size_t count) = 0;
  /// An entry that is not a text: the bytes as a little-endian number.
  virtual void number(const RosField& field, std::uint64_t bits) = 0;
  virtual void text(const RosField& field, std::string_view text) = 0;
};

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

  /// Both throw RejectedMessage for bytes that do not match the definition exactly.
  void visit(const std::uint8_t* data, std::size_t size, RosVisitor& visitor) const;
  RosValues read(const std::uint8_t* data, std::size_t size) const;

 private:
  using Types = std::map<std::string, std::string, std::less<>>;  ///< text by name
  class Reader;

  static std::vector<RosField> fieldsOf(std::string_view text, const std::string& package,
                                        const std::string& prefix, const Types& types, int depth);
  static std::size_t leastOf(const std::vector<RosField>& fields);
  static void addNames(const std::vector<RosField>& fields, bool in_array,
                       std::vector<Name>& names);

  std::vector<RosField> fields_;
};

}  // namespace whirl_twin
