// `twin controllers`: the types of controller available in a scene.
#include <gtest/gtest.h>

#include "twin_program.h"

namespace whirl_twin {
namespace controllers_command_test {

using Json = nlohmann::json;

TEST(Controllers, AreToldWithUnitsAndDefaults) {
  const Ending end = twin({"controllers", "pid", "--json"});
  ASSERT_EQ(end.status, 0) << end.err;
  const Json controllers = end.json()["controllers"];
  ASSERT_EQ(controllers.size(), 1u);
  const Json& pid = controllers["pid"];
  EXPECT_EQ(pid["parameters"]["tracking_time"]["unit"], "s");
  EXPECT_EQ(pid["parameters"]["tracking_time"]["range"], ">= 0");
  EXPECT_EQ(pid["parameters"]["kp"]["default"], 0.0);
  EXPECT_EQ(pid["settings"]["anti_windup"]["default"], "back_calculation");
}

// The shaft speed of a model is not a parameter where it has a drive; a target speed has no
// default.
TEST(Controllers, ASpeedThatIsAskedForIsRequired) {
  const Json speed = twin({"controllers", "speed", "--json"}).json()["controllers"]["speed"];
  EXPECT_EQ(speed["parameters"]["speed"]["required"], true);
  const Ending said = twin({"controllers", "speed"});
  EXPECT_EQ(said.out.find("or a drive"), std::string::npos) << said.out;
  const Json rotor = twin({"models", "jeffcott_rotor", "--json"}).json()["models"];
  EXPECT_EQ(rotor["jeffcott_rotor"]["parameters"]["speed"]["required"], false);
}

TEST(Controllers, AllOfThemHaveAWordForThemselves) {
  const Json controllers = twin({"controllers", "--json"}).json()["controllers"];
  EXPECT_GE(controllers.size(), 7u);
  for (const auto& [name, controller] : controllers.items()) {
    EXPECT_NE(controller["summary"], "") << name;
  }
}

TEST(Controllers, ANameThatNoneHasIsRefusedWithTheNearest) {
  const Ending wrong = twin({"controllers", "pdi", "lqr"});
  EXPECT_EQ(wrong.status, 2);
  EXPECT_TRUE(wrong.out.empty());
  EXPECT_NE(wrong.err.find("no controller 'pdi'"), std::string::npos) << wrong.err;
}

}  // namespace controllers_command_test
}  // namespace whirl_twin
