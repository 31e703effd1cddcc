// `twin models`: what a scene can name.
#include <gtest/gtest.h>

#include "twin_program.h"

namespace whirl_twin {
namespace {

using Json = nlohmann::json;

TEST(Models, JeffcottRotorWithItsUnitsAndDefaults) {
  const Ending end = twin({"models", "jeffcott_rotor", "--json"});
  ASSERT_EQ(end.status, 0) << end.err;
  const Json models = end.json()["models"];
  ASSERT_EQ(models.size(), 1u);
  const Json& rotor = models["jeffcott_rotor"];
  EXPECT_EQ(rotor["linear"], true);
  EXPECT_EQ(rotor["shaft"], true);
  EXPECT_EQ(rotor["rotor"], true);
  EXPECT_EQ(rotor["coordinates"]["x"]["unit"], "m");
  const Json& parameters = rotor["parameters"];
  EXPECT_EQ(parameters["mass"]["unit"], "kg");
  EXPECT_EQ(parameters["mass"]["range"], "> 0");
  EXPECT_EQ(parameters["mass"]["required"], true);
  EXPECT_TRUE(parameters["mass"]["default"].is_null());
  EXPECT_EQ(parameters["damping"]["range"], ">= 0");
  EXPECT_EQ(parameters["damping"]["default"], 0.0);
  EXPECT_EQ(parameters["damping"]["required"], false);
  EXPECT_EQ(parameters["stiffness_y"]["default"], "stiffness");
  EXPECT_EQ(parameters["speed"]["unit"], "rad/s");
  EXPECT_EQ(parameters["speed"]["required"], false) << "a drive does instead";
  const Json& integrators = rotor["integrators"];
  for (const char* name : {"auto", "runge_kutta_4", "gauss_legendre_6", "exponential"}) {
    EXPECT_NE(std::find(integrators.begin(), integrators.end(), name), integrators.end()) << name;
  }
}

TEST(Models, OnlyOnesOnAShaftHaveASpeed) {
  const Json models = twin({"models", "--json"}).json()["models"];
  EXPECT_GE(models.size(), 3u);
  for (const auto& [name, model] : models.items()) {
    EXPECT_EQ(model["parameters"].contains("speed"), model["shaft"].get<bool>()) << name;
    EXPECT_NE(model["summary"], "") << name;
    // A system given by matrices has as many as they have rows.
    EXPECT_EQ(model["coordinates"].empty(),
              name == "linear_system" || name == "cantilever_beam" || name == "flexible_rotor")
        << name;
  }
}

TEST(Models, ListForReadersHasEveryModel) {
  const Json models = twin({"models", "--json"}).json()["models"];
  const Ending list = twin({"models"});
  EXPECT_EQ(list.status, 0);
  for (const auto& [name, model] : models.items()) {
    EXPECT_NE(list.out.find(name + ": "), std::string::npos) << name;
    const Ending one = twin({"models", name});
    EXPECT_NE(list.out.find(one.out), std::string::npos) << name;
    for (const auto& [parameter, about] : model["parameters"].items()) {
      EXPECT_NE(one.out.find(parameter), std::string::npos) << name << " " << parameter;
    }
  }
}

}  // namespace
}  // namespace whirl_twin
