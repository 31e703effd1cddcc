// Controllers that are not built in: when they are requested, and which are accepted.
#include <gtest/gtest.h>

#include <algorithm>

#include "controllers/controller_registry.h"

namespace whirl_twin {
namespace controller_source_test {

int asked = 0;
std::vector<std::string> warnings;

/// A copy of a built-in controller under another name, and three that cannot be taken.
std::vector<ControllerInfo> furtherControllers() {
  ++asked;
  ControllerInfo another = *findController("pid");
  another.name = "another_law";
  ControllerInfo same = another;
  same.summary = "of the same name";
  ControllerInfo nothing;
  nothing.name = "nothing";
  return {another, same, *findController("pid"), nothing};
}

// One test, for a source is asked once in the life of a program.
TEST(ControllerSource, IsAskedOnceAndOnlyForWhatIsNotBuiltIn) {
  setControllerSource(furtherControllers,
                      [](const std::string& text) { warnings.push_back(text); });
  const ControllerInfo* pid = findController("pid");
  ASSERT_NE(pid, nullptr);
  EXPECT_EQ(asked, 0) << "a scene of built-in controllers loads no plugin";

  ASSERT_NE(findController("another_law"), nullptr);
  EXPECT_NE(findController("another_law")->summary, "of the same name") << "the first has the name";
  EXPECT_EQ(findController("unheard_of"), nullptr);
  EXPECT_EQ(findController("nothing"), nullptr);
  EXPECT_EQ(asked, 1);
  EXPECT_EQ(findController("pid"), pid) << "running twins keep pointers";

  const std::vector<std::string> names = controllerNames();
  EXPECT_TRUE(std::is_sorted(names.begin(), names.end()));
  EXPECT_EQ(std::count(names.begin(), names.end(), "another_law"), 1);
  EXPECT_EQ(std::count(names.begin(), names.end(), "pid"), 1);

  ASSERT_EQ(warnings.size(), 3u);
  EXPECT_NE(warnings[0].find("'another_law'"), std::string::npos);
  EXPECT_NE(warnings[1].find("'pid'"), std::string::npos);
  EXPECT_NE(warnings[2].find("'nothing'"), std::string::npos);
}

}  // namespace controller_source_test
}  // namespace whirl_twin
