// A uniform cantilever in bending by assumed modes, loaded at its tip and shaken at its clamp
// (lecture notes, assumed modes method, "example of a continuous system").
//
// The n assumed shapes give n modes; q_i is the deflection of the tip in mode i, relative to the
// clamp, so that M and K are diagonal and the tip's deflection is the sum of all q. Frequencies are
// upper bounds (Rayleigh-Ritz): good to 1 % in the lower half of the modes, far too high in the
// highest ones. With two modes or more the static deflection of a tip force is exact. A clamp that
// moves by Y sin(w t) loads a mode with Q_i = -m Y'' integral of phi_i dx.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "algebra/constants.h"
#include "analysis/cantilever_modes.h"
#include "analysis/natural_modes.h"
#include "integration/linear_methods.h"
#include "models/linear_rotor_setup.h"
#include "models/models.h"

namespace whirl_twin {

namespace {

constexpr int kMaxModes = 30;
constexpr int kSketchParts = 32;

/// [m] from the clamp: the ends of the parts that the beam is drawn in.
Eigen::VectorXd sketchPlaces(double length) {
  return Eigen::VectorXd::LinSpaced(kSketchParts + 1, 0.0, length);
}

struct ClampMotion {
  double amplitude;  ///< [m]
  double frequency;  ///< [rad/s]
  double at(double time) const { return amplitude * std::sin(frequency * time); }
};

/// The bent beam, its clamp and the force on its tip, which is drawn in parts of its amplitude.
struct BeamPicture {
  double length;
  Eigen::MatrixXd shapes;  ///< phi_i at sketchPlaces, one column a mode
  ClampMotion clamp;
  HarmonicForce tip;  ///< one component

  Sketch operator()(const Eigen::VectorXd& q, double time) const {
    Sketch sketch;
    sketch.size = 1.3 * length;
    sketch.height = length;
    sketch.centre = {0.5 * length, 0.0, 0.0};
    const double base = clamp.at(time);
    const Eigen::VectorXd x = sketchPlaces(length);
    const Eigen::VectorXd z = (shapes * q).array() + base;
    for (Eigen::Index i = 0; i < kSketchParts; ++i) {
      sketch.rods.push_back(
          {{x[i], 0.0, z[i]}, {x[i + 1], 0.0, z[i + 1]}, 0.012 * length, SketchRole::kBody});
    }
    sketch.boxes.push_back({{-0.04 * length, 0.0, base},
                            {0.08 * length, 0.1 * length, 0.25 * length},
                            0.0,
                            SketchRole::kSupport});
    const SketchPoint end{length, 0.0, z[kSketchParts]};
    if (tip.amplitude[0] != 0.0) {
      const double force = std::cos(tip.frequency * time + tip.phase);
      const double sign = tip.amplitude[0] > 0.0 ? 1.0 : -1.0;
      sketch.arrows.push_back({end, {end.x, 0.0, end.z + 0.25 * length * sign * force}});
    }
    sketch.tracer = end;
    sketch.has_tracer = true;
    return sketch;
  }
};

/// The tip's deflection is the sum of all coordinates.
InputInfo forceAtTip(Eigen::Index modes) {
  return {"force", "N", Eigen::VectorXd::Ones(modes), "across the beam at its free end"};
}

void requirePositive(const ParameterValues& values) {
  for (const char* name : {"mass_per_length", "length", "bending_stiffness"}) {
    if (!(values.at(name) > 0.0)) {
      throw SetupError(name, fmt::format("must be > 0, found {}", values.at(name)));
    }
  }
  const double modes = values.at("modes");
  if (!(modes >= 1.0 && modes <= kMaxModes && modes == std::floor(modes))) {
    throw SetupError(
        "modes", fmt::format("must be a whole number from 1 to {}, found {}", kMaxModes, modes));
  }
}

ModelSetup setUpCantilever(const ParameterValues& values) {
  requirePositive(values);
  const double length = values.at("length");
  const double mass_per_length = values.at("mass_per_length");
  const CantileverModes beam =
      cantileverModes(mass_per_length, length, values.at("bending_stiffness"),
                      static_cast<int>(values.at("modes")));
  const NaturalModes natural = naturalModes(beam.mass, beam.stiffness);
  // Mode shapes of unit deflection at the tip.
  const Eigen::VectorXd tip = natural.shapes.transpose() * beam.tip;
  const Eigen::MatrixXd shapes = natural.shapes * tip.cwiseInverse().asDiagonal();
  const Eigen::ArrayXd mass = tip.array().square().inverse();
  const Eigen::ArrayXd& p = natural.frequencies.array();
  const Eigen::Index n = tip.size();

  LinearModel model;
  model.model = "cantilever_beam";
  for (Eigen::Index i = 1; i <= n; ++i) {
    model.coordinates.push_back({fmt::format("q{}", i), "m"});
  }
  model.mass = mass.matrix().asDiagonal();
  model.stiffness = (mass * p.square()).matrix().asDiagonal();
  model.damping = (2.0 * values.at("damping_ratio") * mass * p).matrix().asDiagonal();
  model.gyroscopic = model.circulatory = Eigen::MatrixXd::Zero(n, n);

  const HarmonicForce tip_force{Eigen::VectorXd::Constant(n, values.at("tip_force")),
                                values.at("tip_force_frequency"), 0.0};
  const ClampMotion clamp{values.at("base_motion"), values.at("base_motion_frequency")};
  if (values.at("tip_force") != 0.0) {
    model.forces.push_back(tip_force);
  }
  if (clamp.amplitude != 0.0 && clamp.frequency != 0.0) {
    const double inertia = mass_per_length * clamp.amplitude * clamp.frequency * clamp.frequency;
    // sin(w t) = cos(w t - pi / 2)
    model.forces.push_back(
        {inertia * (shapes.transpose() * beam.integral), clamp.frequency, -0.5 * kPi});
  }

  model.inputs = {forceAtTip(n)};

  BeamPicture picture{length, Eigen::MatrixXd(kSketchParts + 1, n), clamp, tip_force};
  const Eigen::VectorXd places = sketchPlaces(length);
  for (Eigen::Index i = 0; i <= kSketchParts; ++i) {
    picture.shapes.row(i) = beam.shapes(std::min(places[i], length)).transpose() * shapes;
  }
  model.sketch = picture;
  return linearSetup(std::move(model));
}

}  // namespace

ModelInfo cantileverBeamInfo() {
  ModelInfo info;
  info.name = "cantilever_beam";
  info.summary = "uniform cantilever in bending, by assumed modes";
  info.coordinates_meaning =
      "q1, q2 ... (m): contribution of each mode to the deflection of the tip, up";
  info.parameters = {
      {"mass_per_length", "kg/m", Range::kPositive, "of the beam", {}, ""},
      {"length", "m", Range::kPositive, "of the beam", {}, ""},
      {"bending_stiffness", "N m^2", Range::kPositive, "EI of the beam", {}, ""},
      {"modes", "-", Range::kCount, "number, up to 30; the higher half of them is inaccurate", 3.0,
       ""},
      {"damping_ratio", "-", Range::kNotNegative, "of every mode", 0.0, ""},
      {"tip_force", "N", Range::kAny, "across the beam at its free end, F cos(w t)", 0.0, ""},
      {"tip_force_frequency", "rad/s", Range::kNotNegative, "0: a constant force", 0.0, ""},
      {"base_motion", "m", Range::kAny, "amplitude of the clamp across the beam, Y sin(w t)", 0.0,
       ""},
      {"base_motion_frequency", "rad/s", Range::kNotNegative, "of the clamp", 0.0, ""}};
  info.variants = {{"", {}, true, false, linearMethodNames()}};
  info.variants[0].inputs = {forceAtTip(0)};
  info.setUp = [](const ParameterValues& values, const Settings&, const ModelContext&) {
    return setUpCantilever(values);
  };
  return info;
}

}  // namespace whirl_twin
