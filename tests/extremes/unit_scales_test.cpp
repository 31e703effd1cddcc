// Invariance of the motion under a change of units: with masses of 1e-9 or 1e9 of a kilogram and
// lengths of a micrometre or a kilometre as units. Scales that are powers of two change no digit of
// a double, so neither may they change one of the result.
#include <gtest/gtest.h>

#include <cctype>
#include <cmath>
#include <cstdlib>
#include <set>
#include <sstream>

#include "general_position.h"
#include "measured.h"
#include "twin/twin.h"

namespace whirl_twin {
namespace unit_scales_test {

/// Of a unit as the models write them ("N m s/rad", "kg m^2", "Pa s"): powers of mass and length.
struct Dimension {
  int mass = 0;
  int length = 0;
};

Dimension dimensionOf(const std::string& unit) {
  Dimension d;
  std::string words;
  int sign = 1;
  for (const char c : unit) {
    words += c == '/' ? std::string(" / ") : std::string(1, c);
  }
  std::istringstream in(words);
  for (std::string word; in >> word;) {
    if (word == "/") {
      sign = -1;
      continue;
    }
    const std::size_t caret = word.find('^');
    const int power = sign * (caret == std::string::npos ? 1 : std::atoi(word.c_str() + caret + 1));
    const std::string name = word.substr(0, caret);
    // Seconds and radians stay: N = kg m/s^2, Pa = kg/(m s^2).
    d.mass += name == "kg" || name == "N" || name == "Pa" ? power : 0;
    d.length += name == "m" || name == "N" ? power : name == "Pa" ? -power : 0;
    if (name != "kg" && name != "N" && name != "Pa" && name != "m" && name != "s" &&
        name != "rad" && name != "-" && name != "1") {
      ADD_FAILURE() << "unknown unit " << name << " in " << unit;
    }
  }
  return d;
}

struct Scales {
  double mass = 1.0;
  double length = 1.0;
  double of(const std::string& unit) const {
    const Dimension d = dimensionOf(unit);
    return std::pow(mass, d.mass) * std::pow(length, d.length);
  }
};

/// The same motion in other units.
Scene rescaled(Scene scene, const Scales& scales) {
  scene.gravity *= scales.length;
  SystemSpec& spec = scene.systems[0];
  const ModelInfo& model = *findModel(spec.model);
  for (const ParameterInfo& p : model.parameters) {
    spec.parameters[p.name] *= scales.of(p.unit);
  }
  for (const SettingInfo& setting : model.settings) {
    for (TableRow& row : spec.settings.tables[setting.name]) {
      for (const ColumnInfo& column : setting.columns) {
        row.numbers[column.name] *= scales.of(column.unit);
      }
    }
    if (spec.settings.tables[setting.name].empty()) {
      spec.settings.tables.erase(setting.name);
    }
  }
  for (auto& [name, matrix] : spec.settings.matrices) {
    matrix *= scales.mass;  // coordinates all in m
  }
  for (DriveSpec& drive : scene.drives) {
    if (drive.motor) {
      const double torque = scales.mass * scales.length * scales.length;
      for (MotorPoint& point : drive.motor->points) {
        point.torque *= torque;
      }
      drive.motor->drag *= torque;
    }
  }
  return scene;
}

void rescaleStart(Scene& scene, const std::vector<CoordinateInfo>& coordinates,
                  const Scales& scales) {
  SystemSpec& spec = scene.systems[0];
  for (std::size_t i = 0; i < spec.q.size(); ++i) {
    spec.q[i] *= scales.of(coordinates[i].unit);
    spec.v[i] *= scales.of(coordinates[i].unit);
  }
}

/// q, v and the audited work after some steps, in the units of the start.
std::vector<double> motion(Scene scene, const Scales& scales) {
  const std::vector<CoordinateInfo> coordinates = Twin(scene).systems()[0]->dynamics->coordinates();
  scene = rescaled(scene, scales);
  rescaleStart(scene, coordinates, scales);
  Twin twin(scene);
  for (int i = 0; i < 500; ++i) {
    twin.step();
  }
  EXPECT_EQ(twin.status(0), StepStatus::kOk);
  std::vector<double> record(twin.layout().size);
  twin.write(record.data());
  const std::size_t n = coordinates.size();
  const SystemView system = twin.layout().system(record.data(), 0);
  std::vector<double> state;
  for (std::size_t i = 0; i < 2 * n; ++i) {
    state.push_back(system.motion()[i] / scales.of(coordinates[i % n].unit));
  }
  state.push_back(system.work() / scales.of("N m"));
  return state;
}

class InOtherUnits : public testing::TestWithParam<MovingVariant> {
 protected:
  Scene scene() const {
    Scene scene;
    scene.step = kMillisecond;
    scene.systems.push_back(inGeneralPosition(GetParam(), scene));
    SystemSpec& spec = scene.systems[0];
    if (spec.parameters.count("rub_friction") != 0) {
      spec.parameters["rub_friction"] = 0.0;  // rounded off within a sliding of 1e-3 m/s
    }
    if (spec.model == "flexible_rotor") {
      // Coordinates of its nodes: modes of a round shaft come in pairs, in any two directions.
      spec.settings.choices["modes"] = "0";
      const std::size_t spin = GetParam().variant.motor ? 1 : 0;
      spec.q.assign(8 + spin, 0.1);
      spec.v.assign(8 + spin, 0.2);
    }
    return scene;
  }
  /// The stages of an implicit method and the scaling of a matrix exponential depend on the largest
  /// number, whatever its unit: where m and rad are mixed, the last digit may differ.
  bool minglesUnits() const {
    const Scene alone = scene();
    std::set<std::string> units;
    for (const CoordinateInfo& c : Twin(alone).systems()[0]->dynamics->coordinates()) {
      units.insert(c.unit);
    }
    return units.size() > 1 &&
           (iterates(GetParam().integrator) || GetParam().integrator == "exponential");
  }
};

TEST_P(InOtherUnits, TheMotionIsTheSame) {
  const std::vector<double> plain = motion(scene(), {});
  double largest = 0.0;
  for (const double x : plain) {
    largest = std::fmax(largest, std::fabs(x));
  }
  // The rounds by which a whirl and its motor's spin agree end a little above that.
  const bool in_rounds = GetParam().variant.motor && GetParam().integrator == "exponential";
  const double rounding = minglesUnits() ? (in_rounds ? 2e-13 : 1e-14) * largest : 0.0;
  // The exact step makes its audit of the work from that of unit coordinates: of 1 rad and 1 um.
  const double work_rounding = minglesUnits() ? 1e-10 * largest : 0.0;
  for (const Scales& scales : {Scales{0x1p30, 1.0}, Scales{0x1p-30, 1.0}, Scales{1.0, 0x1p10},
                               Scales{1.0, 0x1p-20}, Scales{0x1p-30, 0x1p-20}}) {
    const std::vector<double> other = motion(scene(), scales);
    for (std::size_t i = 0; i < plain.size(); ++i) {
      EXPECT_NEAR(other[i], plain[i], i + 1 < plain.size() ? rounding : work_rounding)
          << i << " in 2^" << std::log2(scales.mass) << " kg, 2^" << std::log2(scales.length)
          << " m";
    }
  }
  for (const Scales& scales :
       {Scales{1e9, 1e3}, Scales{1e-9, 1e-6}, Scales{1e9, 1e-6}, Scales{1e-9, 1e3}}) {
    const std::vector<double> other = motion(scene(), scales);
    for (std::size_t i = 0; i < plain.size(); ++i) {
      // Every parameter is rounded by 1e-16, half a second of motion later that is 1e-13.
      EXPECT_NEAR(other[i], plain[i], 1e-12 * largest)
          << i << " in " << scales.mass << " kg, " << scales.length << " m";
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Models, InOtherUnits, testing::ValuesIn(everyMovingVariant()),
                         [](const auto& test) { return testName(test.param); });

}  // namespace unit_scales_test
}  // namespace whirl_twin
