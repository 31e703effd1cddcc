// The files in msg/ agree with the lists of fields in src/messages.
#include <gtest/gtest.h>

#include <fstream>
#include <regex>
#include <string>
#include <utility>
#include <vector>

#include "messages/alert.h"
#include "messages/message.h"

namespace whirl_twin {
namespace message_files_test {

struct Line {
  std::string type, name, comment;
};

/// The fields of msg/TYPE.msg in order, without the header.
std::vector<Line> fieldsOf(const std::string& type) {
  std::ifstream file(WHIRL_TWIN_SOURCE "/msg/" + type + ".msg");
  std::vector<Line> lines;
  const std::regex field(R"((\S+)\s+([a-z]\w*)\s*(?:#\s*(.*))?)");
  for (std::string text; std::getline(file, text);) {
    std::smatch found;
    if (std::regex_match(text, found, field) && found[1] != "std_msgs/Header" &&
        text.front() != '#') {
      lines.push_back({found[1], found[2], found[3]});
    }
  }
  return lines;
}

/// The fields of a list as a .msg file has them, with their units.
class FileVisit : public FieldVisit<FileVisit> {
 public:
  std::vector<std::pair<std::string, std::string>> fields;

  void head() { fields.insert(fields.end(), {{"step", ""}, {"time", "s"}}); }
  template <class F>
  void head(F) {
    head();
  }
  template <class F>
  void sampled(F) {
    fields.insert(fields.end(), {{"sample", ""}, {"time", "s"}});
  }
  template <class F, class Check>
  void value(F field, const char* unit, Check, Stays) {
    fields.emplace_back(field.name, unit);
  }
  template <class L, class F>
  void rows(L, F) {
    state::CriticalSpeedMargin::fields(*this);
  }
  template <class F, class Of>
  void derived(F field, Of) {
    fields.emplace_back(field.name, "");
  }
};

TEST(MessageFiles, ListTheSameFieldsWithTheSameUnits) {
  eachKind([](auto kind) {
    using State = typename decltype(kind)::State;
    FileVisit visit;
    State::fields(visit);
    const std::string type =
        State::kKind.type == std::string("AlertArray") ? "Alert" : State::kKind.type;
    const std::vector<Line> lines = fieldsOf(type);
    ASSERT_EQ(lines.size(), visit.fields.size()) << type;
    for (std::size_t i = 0; i < lines.size(); ++i) {
      const auto& [name, unit] = visit.fields[i];
      EXPECT_EQ(lines[i].name, name) << type;
      const bool has_unit =
          lines[i].comment == unit || lines[i].comment.rfind(unit + ",", 0) == 0 ||
          lines[i].comment.rfind(unit + " ", 0) == 0 || lines[i].comment.rfind(unit + ";", 0) == 0;
      EXPECT_TRUE(unit.empty() || has_unit)
          << type << "." << name << ": " << unit << "; the file says: " << lines[i].comment;
    }
  });
}

TEST(MessageFiles, NameEveryTypeOfAlert) {
  std::string listed;
  for (const Line& line : fieldsOf("Alert")) {
    listed += line.name == "type" ? line.comment : "";
  }
  std::ifstream header(WHIRL_TWIN_SOURCE "/src/messages/alert.h");
  std::string types;
  const std::regex constant(R"(.*\[\] = "([A-Z_]+)\";.*)");
  for (std::string text; std::getline(header, text);) {
    std::smatch found;
    if (std::regex_match(text, found, constant)) {
      types += (types.empty() ? "" : ", ") + found[1].str();
    }
  }
  EXPECT_NE(types.find(alert_type::kModelInvalid), std::string::npos);
  EXPECT_EQ(listed, types);
}

}  // namespace message_files_test
}  // namespace whirl_twin
