// `twin import`: rotors in the formats of other programs give the same results here.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "twin_program.h"

namespace whirl_twin {
namespace import_command_test {

using Json = nlohmann::json;

constexpr const char* kSteel =
    R"("material": {"name": "Steel", "rho": 7810.0, "E": 211000000000.0, "G_s": 81200000000.0})";

/// ROSS's own rotor_example(), as Rotor.save() writes it: six elements, two discs, two bearings.
std::string rotorExample() {
  std::string text = R"({"ross_version": "2.3.0", "parameters": {"rated_w": null, "max_w": null})";
  for (int n = 0; n < 6; ++n) {
    text += fmt::format(
        R"(, "ShaftElement_Shaft Element {0}": {{"L": 0.25, "idl": 0.0, "odl": 0.05, "idr": 0.0,
        "odr": 0.05, {1}, "n": {0}, "axial_force": 0, "torque": 0, "shear_effects": true,
        "rotary_inertia": true, "gyroscopic": true, "alpha": 0.0, "beta": 0.0}})",
        n, kSteel);
  }
  for (const int n : {2, 4}) {
    text += fmt::format(
        R"(, "DiskElement_Disk {0}": {{"n": {0}, "m": 32.58972765304033, "Id": 0.17808928257067666,
        "Ip": 0.32956362089137037}})",
        n);
  }
  for (const int n : {0, 6}) {
    text += fmt::format(
        R"(, "BearingElement_Bearing {0}": {{"n": {0}, "kxx": [1000000.0], "kyy": [800000.0],
        "kxy": [0], "kyx": [0], "cxx": [0], "cyy": [0], "frequency": null, "n_link": null}})",
        n);
  }
  return text + "}";
}

TEST(Import, ARotorOfRossHasTheFrequenciesThatRossTells) {
  const TemporaryDirectory folder;
  const Ending imported = twin({"import", "ross", folder.write("example.json", rotorExample())});
  ASSERT_EQ(imported.status, 0) << imported.err;
  EXPECT_EQ(imported.err, "");
  const std::string scene = folder.write("example.yaml", imported.out);
  const Json analysis = twin({"analyze", scene, "--json"}).json();
  std::vector<double> frequencies;
  for (const Json& value : analysis["systems"]["rotor"]["eigenvalues"]) {
    frequencies.push_back(std::hypot(value[0].get<double>(), value[1].get<double>()));
  }
  std::sort(frequencies.begin(), frequencies.end());
  ASSERT_GE(frequencies.size(), 4u);
  // As its documentation prints them for rotor_example().run_modal(speed=0).
  EXPECT_NEAR(frequencies[0], 91.79655318, 1e-6);
  EXPECT_NEAR(frequencies[2], 96.28899977, 1e-6);
}

constexpr const char* kMachine = R"(ross_version = "2.0.0"

[parameters]
rated_w = 300.0
max_w = 500.0

["ShaftElement_a"]
L = 0.2
idl = 0.0
odl = 0.06
idr = 0.0
odr = 0.06
n = 0
axial_force = -1000.0
torque = 50.0
alpha = 2.0
beta = 1e-5

["ShaftElement_cone"]
L = 0.1
idl = 0.02
odl = 0.06
idr = 0.02
odr = 0.05
n = 1
alpha = 2.0
beta = 1e-5

["ShaftElement_sleeve"]
L = 0.2
idl = 0.06
odl = 0.1
idr = 0.06
odr = 0.1
n = 0
alpha = 2.0
beta = 1e-5

["ShaftElement_ring"]
L = 0.2
idl = 0.1
odl = 0.12
idr = 0.1
odr = 0.12
n = 0
alpha = 2.0
beta = 1e-5

["DiskElement_D"]
n = 1
m = 5.0
Id = 0.02
Ip = 0.03

["PointMass_P"]
n = 2
m = 1.5

["BearingElement_B"]
n = 0
kxx = [1e7,]
kyy = [2e7,]
cxx = [100.0,]
cyy = [200.0,]
mxx = [0.5,]
myy = [0.25,]
n_link = 3

["PointMass_casing"]
n = 3
mx = 40.0
my = 50.0

["BearingElement_foundation"]
n = 3
kxx = [5e7,]
cxx = [1e4,]

["SealElement_S"]
n = 2
frequency = [100.0, 200.0,]
kxx = [1e6, 2e6,]
kyy = [1e6, 2e6,]
kxy = [3e5, 4e5,]
kyx = [-3e5, -4e5,]
cxx = [10.0, 20.0,]
cyy = [10.0, 20.0,]

["GearElement_G"]
n = 1
m = 4.0

["ShaftElement_a".material]
name = "Steel 4140"
rho = 7800.0
E = 2.1e11
G_s = 8e10

["ShaftElement_cone".material]
name = "Steel 4140"
rho = 7800.0
E = 2.1e11
G_s = 8e10

["ShaftElement_sleeve".material]
name = "Bronze"
rho = 8800.0
E = 1.1e11
G_s = 4.2e10

["ShaftElement_ring".material]
name = "Steel 4140"
rho = 7800.0
E = 1e-2
G_s = 8e10
)";

TEST(Import, AMachineOfRossHasItsLayersConesSealsAndPedestals) {
  const TemporaryDirectory folder;
  const std::string file = folder.write("pump-7.toml", kMachine);
  const std::string scene = folder.file("pump.yaml");
  const Ending imported = twin({"import", "ross", file, "--output", scene});
  ASSERT_EQ(imported.status, 0) << imported.err;
  EXPECT_EQ(imported.out, "");
  EXPECT_NE(imported.err.find("not carried over: GearElement_G: a GearElement"), std::string::npos);
  EXPECT_EQ(linesOf(imported.err).size(), 1u) << imported.err;
  const std::string text = contentsOf(scene);
  for (const char* line :
       {"# - GearElement_G: a GearElement", "name: pump_7\n", "speed: 300 ", "highest_speed: 500 ",
        "shear_modulus: 80000000000 ", "mass_damping: 2 ", "stiffness_damping: 1e-05 ",
        "- {length: 0.2, outer_diameter: 0.06, axial_force: -1000, torque: 50}",
        "- {length: 0.1, outer_diameter: 0.06, outer_diameter_end: 0.05, inner_diameter: 0.02, "
        "inner_diameter_end: 0.02}",
        "- {material: Bronze, from: 0, to: 1, outer_diameter: 0.1, inner_diameter: 0.06}",
        "- {from: 0, to: 1, outer_diameter: 0.12, inner_diameter: 0.1, stiffness_share: 0.0}",
        "- {node: 1, mass: 5, polar_inertia: 0.03, transverse_inertia: 0.02}",
        "- {node: 2, mass: 1.5}",
        "- {node: 0, kxx: 10000000, kyy: 20000000, cxx: 100, cyy: 200, mxx: 0.5, myy: 0.25}",
        "- {node: 2}\n",
        "- {bearing: 1, speed: 200, kxx: 2000000, kyy: 2000000, kxy: 400000, kyx: -400000, cxx: "
        "20, cyy: 20}",
        "- {node: 0, mass: 40, mass_y: 50, kxx: 50000000, cxx: 10000}"}) {
    EXPECT_NE(text.find(line), std::string::npos) << line << "\n" << text;
  }
  // By hand: shaft, cone, sleeve, ring; disc and point mass. A casing and a film have no part.
  const auto ring = [](double outer, double inner, double length) {
    return M_PI / 4.0 * (outer * outer - inner * inner) * length;
  };
  const double cone =
      M_PI / 12.0 * 0.1 * (0.06 * 0.06 + 0.06 * 0.05 + 0.05 * 0.05) - ring(0.02, 0.0, 0.1);
  const double mass = 7800.0 * (ring(0.06, 0.0, 0.2) + cone + ring(0.12, 0.1, 0.2)) +
                      8800.0 * ring(0.1, 0.06, 0.2) + 6.5;
  const Json analysis = twin({"analyze", scene, "--json"}).json();
  EXPECT_NEAR(analysis["systems"]["rotor"]["rotor"]["mass"].get<double>(), mass, 1e-6 * mass);
}

// The coupling of ROSS's documentation, of 151.55 kg, with a lateral stiffness; a foundation over
// frequency.
constexpr const char* kTrain = R"(
["ShaftElement_a"]
L = 0.3
idl = 0.0
odl = 0.08
n = 0
["ShaftElement_a".material]
name = "Steel"
rho = 7810.0
E = 2.11e11
G_s = 8.12e10

["CouplingElement_c"]
n = 1
m_l = 75.775
m_r = 75.775
Ip_l = 1.0985
Ip_r = 1.0985
kt_x = 2e8
kt_y = 2e8
kr_x = 5e4
kr_y = 6e4
kr_z = 3.04256e6
L = 0.25
o_d = 0.3

["ShaftElement_b"]
L = 0.4
idl = 0.0
odl = 0.08
n = 2
["ShaftElement_b".material]
name = "Steel"
rho = 7810.0
E = 2.11e11
G_s = 8.12e10

["BearingElement_l"]
n = 0
kxx = [1e8,]
cxx = [1e3,]
n_link = 9

["BearingElement_r"]
n = 3
kxx = [1e8,]
cxx = [1e3,]

["PointMass_p"]
n = 9
m = 60.0

["BearingElement_f"]
n = 9
frequency = [0.0, 400.0,]
kxx = [4e7, 3e7,]
kyy = [4e7, 3e7,]
cxx = [1e4, 2e4,]
cyy = [1e4, 2e4,]
)";

TEST(Import, ACouplingOfRossJoinsTwoShaftsAndAFoundationFollowsTheSpeed) {
  const TemporaryDirectory folder;
  const std::string scene = folder.file("train.yaml");
  const Ending imported =
      twin({"import", "ross", folder.write("train.toml", kTrain), "--output", scene});
  ASSERT_EQ(imported.status, 0) << imported.err;
  EXPECT_EQ(linesOf(imported.err).size(), 2u) << imported.err;
  EXPECT_NE(imported.err.find("CouplingElement_c: kr_y differs from kr_x"), std::string::npos);
  EXPECT_NE(imported.err.find("CouplingElement_c: kr_z, along or about"), std::string::npos);
  const std::string text = contentsOf(scene);
  for (const char* line :
       {"- {length: 0.25, outer_diameter: 0.3}",
        "- {element: 1, lateral_stiffness: 200000000, bending_stiffness: 50000,",
        "- {node: 1, mass: 75.775, polar_inertia: 1.0985, transverse_inertia: 0.54925}",
        "- {node: 2, mass: 75.775, polar_inertia: 1.0985, transverse_inertia: 0.54925}",
        "- {node: 0, mass: 60}\n", "- {pedestal: 0, speed: 400, kxx: 30000000, kyy: 30000000,"}) {
    EXPECT_NE(text.find(line), std::string::npos) << line << "\n" << text;
  }
  const Json analysis = twin({"analyze", scene, "--json"}).json();
  EXPECT_NEAR(analysis["systems"]["rotor"]["rotor"]["mass"].get<double>(),
              151.55 + 7810.0 * 0.7 * M_PI * 0.0016, 1e-6);
}

/// A shaft of four elements of steel, 1 m long, 50 mm thick, with a disc of 32.59 kg at its middle.
std::string shaftWithDisc(const std::string& version, const std::string& further) {
  std::string text = fmt::format("ross_version = \"{}\"\n[parameters]\n", version);
  for (int n = 0; n < 4; ++n) {
    text += fmt::format(R"(["ShaftElement_{0}"]
L = 0.25
idl = 0.0
odl = 0.05
n = {0}
["ShaftElement_{0}".material]
name = "Steel"
rho = 7810.0
E = 211000000000.0
G_s = 81200000000.0
)",
                        n);
  }
  return text + "[\"DiskElement_0\"]\nn = 2\nm = 32.59\nIp = 0.329\nId = 0.178\n" + further;
}

/// Two bearings alike, at the ends.
std::string bearings(const std::string& coefficients) {
  return "[\"BearingElement_0\"]\nn = 0\n" + coefficients + "[\"BearingElement_1\"]\nn = 4\n" +
         coefficients;
}

/// Frequencies [rad/s] of the modes at 300 rad/s, rising.
std::vector<double> frequenciesAt300(const std::string& scene) {
  std::vector<double> all;
  const Json json = twin({"modes", scene, "--speed", "300", "--json"}).json();
  for (const Json& mode : json["systems"]["rotor"]["modes"]) {
    all.push_back(mode["frequency"].get<double>());
  }
  std::sort(all.begin(), all.end());
  return all;
}

// Beam elements and the second row of the table in a dense eigenproblem, computed beside the
// program: 175.82, 187.63, 594.31, 706.16 rad/s.
TEST(Import, ATableOfRoss3IsOfTheSpeedAndOneOfTwoAxesIsTakenWhereTheWhirlHasTheSpeed) {
  const std::string damping = "cxx = [100.0, 80.0, 60.0]\ncyy = [100.0, 80.0, 60.0]\n";
  const std::string other = "mxy = [0, 0, 0]\nmyx = [0, 0, 0]\n";
  const std::string of_speed =
      "speed = [100.0, 300.0, 500.0]\nkxx = [1.0e6, 1.5e6, 2.0e6]\n"
      "kyy = [0.8e6, 1.2e6, 1.6e6]\n";
  // At a frequency of 300 rad/s the rows are what they are above.
  const std::string of_both =
      "speed = [100.0, 300.0, 500.0]\nfrequency = [0.0, 200.0, 600.0]\n"
      "kxx = [[1.0e6, 1.0e6, 9.0e6], [0.9e6, 1.4e6, 1.8e6], [2.0e6, 2.0e6, 2.0e6]]\n"
      "kyy = [[0.8e6, 0.8e6, 9.0e6], [0.9e6, 1.1e6, 1.5e6], [1.6e6, 1.6e6, 1.6e6]]\n";
  for (const auto& [version, table, remark] : std::vector<std::array<std::string, 3>>{
           {"3.0.0", of_speed, ""},
           {"2.3.0", std::string(of_speed).replace(0, 5, "frequency"), ""},
           {"3.0.0", std::string(of_speed).replace(0, 5, "frequency"), "whirl frequency"},
           {"3.1.0", of_both, "whirl frequency"}}) {
    const TemporaryDirectory folder;
    const Ending imported = twin(
        {"import", "ross",
         folder.write("rotor.toml", shaftWithDisc(version, bearings(table + damping + other)))});
    ASSERT_EQ(imported.status, 0) << imported.err;
    EXPECT_EQ(imported.err.find("BearingElement") != std::string::npos, !remark.empty());
    EXPECT_NE(imported.err.find(remark), std::string::npos) << imported.err;
    const std::vector<double> found = frequenciesAt300(folder.write("rotor.yaml", imported.out));
    const double expected[] = {175.82, 187.63, 594.31, 706.16};
    ASSERT_GE(found.size(), 4u);
    for (std::size_t i = 0; i < 4; ++i) {
      EXPECT_NEAR(found[i], expected[i], 1e-3 * expected[i]) << table;
    }
  }
}

// The same rotor as dense beam elements: 59.92 kg, 150.01 and 463.12 rad/s at rest, each twice.
TEST(Import, AGearOfRossIsADiscToo) {
  const TemporaryDirectory folder;
  const std::string gear =
      "[\"GearElement_0\"]\nn = 3\nm = 12.0\nIp = 0.1\nId = 0.05\n"
      "n_teeth = 40\npitch_diameter = 0.2\npr_angle = 0.349\n";
  const Ending imported =
      twin({"import", "ross",
            folder.write("gear.toml",
                         shaftWithDisc("2.3.0", bearings("kxx = 1.0e6\ncxx = 100.0\n") + gear))});
  ASSERT_EQ(imported.status, 0) << imported.err;
  EXPECT_NE(
      imported.err.find("GearElement_0: properties of a GearElement besides mass and inertias"),
      std::string::npos)
      << imported.err;
  const std::string scene = folder.write("gear.yaml", imported.out);
  const Json json = twin({"analyze", scene, "--json"}).json()["systems"]["rotor"];
  EXPECT_NEAR(json["rotor"]["mass"].get<double>(), 59.92, 0.01);
  std::vector<double> frequencies;
  for (const Json& value : json["eigenvalues"]) {
    frequencies.push_back(std::hypot(value[0].get<double>(), value[1].get<double>()));
  }
  std::sort(frequencies.begin(), frequencies.end());
  for (const auto& [i, expected] : std::vector<std::pair<std::size_t, double>>{
           {0, 150.01}, {2, 150.01}, {4, 463.12}, {6, 463.12}}) {
    EXPECT_NEAR(frequencies.at(i), expected, 1e-3 * expected);
  }
}

TEST(Import, WhatIsWrongInARotorOfRossIsToldAtOnce) {
  const TemporaryDirectory folder;
  const Ending wrong = twin({"import", "ross", folder.write("wrong.toml", R"(
["ShaftElement_a"]
idl = 0.0
odl = "thick"
n = 1
["ShaftElement_a".material]
E = 2.1e11
rho = 7800.0
["SealElement_s"]
n = 1
frequency = [1.0, 2.0]
kxx = [1.0, 2.0, 3.0]
)")});
  EXPECT_EQ(wrong.status, 2);
  EXPECT_EQ(wrong.out, "");
  for (const char* complaint :
       {"ShaftElement_a.L: must be a number in m, found nothing",
        "ShaftElement_a.odl: must be a number in m, found \"thick\"",
        "ShaftElement_a.material.G_s: must be a number in Pa, found nothing",
        "ShaftElement_a.n: must have a shaft element at node 0, found none",
        "SealElement_s.kxx: must have 2 numbers as frequency has, found 3"}) {
    EXPECT_NE(wrong.err.find(complaint), std::string::npos) << complaint << "\n" << wrong.err;
  }
  for (const auto& [name, text, words] :
       std::vector<std::array<std::string, 3>>{{"no.toml", "a = [1,\n", "must be TOML"},
                                               {"no.json", "{\"a\": ", "must be JSON"},
                                               {"list.json", "[]", "must be a rotor saved by ROSS"},
                                               {"empty.toml", "", "must have a ShaftElement"}}) {
    const Ending refused = twin({"import", "ross", folder.write(name, text)});
    EXPECT_EQ(refused.status, 2) << name;
    EXPECT_NE(refused.err.find(words), std::string::npos) << refused.err;
  }
  std::string number = rotorExample();  // where a material's name is a number it has none
  number.replace(number.find("\"Steel\""), 7, "5");
  EXPECT_EQ(twin({"import", "ross", folder.write("number.json", number)}).status, 0);
  EXPECT_EQ(twin({"import", "ross", folder.file("nothing.toml")}).status, 2);
  EXPECT_EQ(twin({"import", "dyrobes", folder.write("a.toml", "")}).status, 2);
}

TEST(Import, ATableOfElementsIsAShaft) {
  const TemporaryDirectory folder;
  const Ending imported =
      twin({"import", "csv",
            folder.write("shaft.csv",
                         "length (mm), outer_diameter [in],inner_diameter (mm),axial_force (kN)\n"
                         "250,2,10,-5\n250,2,10,-5\n\n125,1,,\n")});
  ASSERT_EQ(imported.status, 0) << imported.err;
  EXPECT_NE(imported.out.find("- {length: 0.25, outer_diameter: 0.0508, inner_diameter: 0.01, "
                              "axial_force: -5000, count: 2}\n        - {length: 0.125, "
                              "outer_diameter: 0.0254}\n"),
            std::string::npos)
      << imported.out;
  const Ending wrong =
      twin({"import", "csv",
            folder.write("wrong.csv", "length (kg),diameter,count\n1,2,three\n,1,1\n")});
  EXPECT_EQ(wrong.status, 2);
  for (const char* complaint :
       {"column 'length (kg)': must be in m or a convertible unit",
        "column 'diameter': is not a column of shaft elements; there are: length, outer_diameter,",
        "the first line must name a column 'outer_diameter'", "line 2: count: must be a number",
        "line 3: length: must be a number, found ''"}) {
    EXPECT_NE(wrong.err.find(complaint), std::string::npos) << complaint << "\n" << wrong.err;
  }
}

}  // namespace import_command_test
}  // namespace whirl_twin
