// `twin models`: the models available in a scene.
#include <gtest/gtest.h>

#include "twin_program.h"

namespace whirl_twin {
namespace models_command_test {

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
    EXPECT_EQ(model.value("parameters", Json::object()).contains("speed"),
              model["shaft"].get<bool>())
        << name;
    EXPECT_NE(model["summary"], "") << name;
    // A system given by matrices has as many as they have rows.
    EXPECT_EQ(model["coordinates"].empty(),
              name == "linear_system" || name == "cantilever_beam" || name == "flexible_rotor")
        << name;
  }
}

TEST(Models, HaveAMeaningForEveryCoordinate) {
  const Json models = twin({"models", "--json"}).json()["models"];
  for (const auto& [name, model] : models.items()) {
    std::vector<Json> forms{model};
    const Json variants = model.value("variants", Json::object());
    forms.insert(forms.end(), variants.begin(), variants.end());
    for (const Json& form : forms) {
      EXPECT_NE(form["coordinates"].empty(), form.value("coordinates_meaning", "").empty()) << name;
      for (const auto& [coordinate, info] : form["coordinates"].items()) {
        EXPECT_NE(info["meaning"], "") << name << ", " << coordinate;
      }
    }
  }
}

TEST(Models, AreToldOfSeveralNames) {
  const Ending two = twin({"models", "spinning_pendulum", "pendulum", "--json"});
  ASSERT_EQ(two.status, 0) << two.err;
  const Json models = two.json()["models"];
  EXPECT_EQ(models.size(), 2u);
  EXPECT_TRUE(models.contains("pendulum") && models.contains("spinning_pendulum"));

  const Ending wrong = twin({"models", "pendulm", "pendulum", "governer"});
  EXPECT_EQ(wrong.status, 2);
  EXPECT_EQ(wrong.out, "");
  EXPECT_EQ(wrong.err,
            "twin: no model 'pendulm'; did you mean 'pendulum'?\n"
            "twin: no model 'governer'; did you mean 'governor'?\n");
}

TEST(Models, ListForReadersHasEveryModel) {
  const Json models = twin({"models", "--json"}).json()["models"];
  const Ending list = twin({"models"});
  EXPECT_EQ(list.status, 0);
  for (const auto& [name, model] : models.items()) {
    EXPECT_NE(list.out.find(name + ": "), std::string::npos) << name;
    const Ending one = twin({"models", name});
    EXPECT_NE(list.out.find(one.out), std::string::npos) << name;
    const Json parameters = model.value("parameters", Json::object());
    for (const auto& [parameter, about] : parameters.items()) {
      EXPECT_NE(one.out.find(parameter), std::string::npos) << name << " " << parameter;
    }
  }
}

}  // namespace models_command_test
}  // namespace whirl_twin
