#include "studies/analysed_numbers.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "algebra/constants.h"
#include "analysis/critical_speeds.h"
#include "analysis/equilibria.h"
#include "analysis/instability_speed.h"
#include "analysis/separation_margin.h"
#include "scene/driven_dynamics.h"
#include "scene/held_rotor.h"

namespace whirl_twin {

namespace {

using NumberKind = AnalysedNumber::Kind;

/// Parts of a name before and after the index.
struct Name {
  const char* before;
  bool listed;
  const char* after;
  NumberKind kind;
  const char* unit;
};
constexpr std::array<Name, 12> kNames{{
    {"critical_speeds", true, "", NumberKind::kCriticalSpeed, "rad/s"},
    {"critical_speeds", true, ".speed", NumberKind::kCriticalSpeed, "rad/s"},
    {"critical_speeds", true, ".amplification_factor", NumberKind::kAmplificationFactor, "-"},
    {"critical_speeds", true, ".separation_margin", NumberKind::kSeparationMargin, "percent"},
    {"natural_frequencies", true, "", NumberKind::kNaturalFrequency, "rad/s"},
    {"damping_ratios", true, "", NumberKind::kDampingRatioOfMode, "-"},
    {"stability.sigma", false, "", NumberKind::kDecayRate, "1/s"},
    {"margins.decay_rate", false, "", NumberKind::kDecayRate, "1/s"},
    {"margins.damping_ratio", false, "", NumberKind::kDampingRatio, "-"},
    {"margins.log_decrement", false, "", NumberKind::kLogDecrement, "-"},
    {"margins.instability_speed", false, "", NumberKind::kInstabilitySpeed, "rad/s"},
    {"separation.reserve", false, "", NumberKind::kSeparationReserve, "percent"},
}};

/// The index in "before[12]after"; empty if the text has a different form.
std::optional<std::size_t> placeIn(const std::string& text, const Name& name) {
  const std::string before = name.before;
  if (!name.listed) {
    return text == before ? std::optional<std::size_t>(0) : std::nullopt;
  }
  if (text.compare(0, before.size() + 1, before + "[") != 0) {
    return std::nullopt;
  }
  std::size_t place = 0;
  const char* const end = text.data() + text.size();
  const auto [after, error] = std::from_chars(text.data() + before.size() + 1, end, place);
  if (error != std::errc() || after == end || *after != ']' ||
      std::string(after + 1, end) != name.after) {
    return std::nullopt;
  }
  return place;
}

Eigen::VectorXd coordinateVector(const std::vector<double>& x) {
  return Eigen::Map<const Eigen::VectorXd>(x.data(), static_cast<Eigen::Index>(x.size()));
}

}  // namespace

std::optional<AnalysedNumber> analysedNumber(const std::string& name, const BuiltScene& scene) {
  for (std::size_t i = 0; i < scene.systems.size(); ++i) {
    const std::string prefix = scene.systems[i]->spec.name + ".";
    const bool named = name.compare(0, prefix.size(), prefix) == 0;
    if (!named && scene.systems.size() > 1) {
      continue;
    }
    const std::string rest = named ? name.substr(prefix.size()) : name;
    for (const Name& known : kNames) {
      if (const auto place = placeIn(rest, known)) {
        return AnalysedNumber{known.kind, i, *place};
      }
    }
  }
  return std::nullopt;
}

std::vector<std::string> analysedNames(const BuiltScene& scene) {
  std::vector<std::string> all;
  for (const SharedSystem& system : scene.systems) {
    for (const Name& known : kNames) {
      const std::string name =
          std::string(known.before) + (known.listed ? "[0]" : "") + known.after;
      all.push_back(scene.systems.size() > 1 ? system->spec.name + "." + name : name);
    }
  }
  return all;
}

std::string unitOf(const AnalysedNumber& number) {
  return std::find_if(kNames.begin(), kNames.end(),
                      [&](const Name& known) { return known.kind == number.kind; })
      ->unit;
}

struct AnalysedScene::Results {
  std::shared_ptr<const Dynamics> dynamics_judged;
  std::optional<Linearization> linearization;
  Eigen::VectorXd about;
  bool periodic = false;  ///< evaluated by the multipliers of a periodic motion
  Stability of_point;     ///< of the operating point
  bool judged = true;     ///< false: no equilibrium, of the rotor in its fluid films or its weight
  std::optional<Stability> stability;
  std::optional<std::vector<CriticalSpeed>> critical_speeds;
  std::optional<double> instability_speed;

  const Linearization& linearizationOf(const BuiltSystem& system, double speed,
                                       const EvaluationPoint<double>& start) {
    if (!linearization) {
      dynamics_judged = judgedDynamics(system.dynamics, system.spec);
      const Dynamics& dynamics = *dynamics_judged;
      const Eigen::VectorXd q = coordinateVector(system.spec.q);
      const Eigen::VectorXd v = coordinateVector(system.spec.v);
      if (const auto point = operatingPoint(dynamics, q, v, speed)) {
        about = point->q;
        periodic = point->periodic.has_value();
        of_point = point->stability;
        linearization = linearizationAbout(dynamics, point->q, point->v, speed);
      } else {
        about = q;
        judged = dynamics.linear() && !isUnsupported(dynamics, speed);
        linearization = dynamics.linearization(q, v, dynamics.acceleration(q, v, start), start);
      }
    }
    return *linearization;
  }

  const Stability& stabilityOf(const BuiltSystem& system, double speed,
                               const EvaluationPoint<double>& start) {
    if (!stability) {
      const Linearization& l = linearizationOf(system, speed, start);
      const Dynamics& dynamics = *dynamics_judged;
      const CyclicCoordinates cyclic = cyclicCoordinates(dynamics, speed);
      stability = !judged             ? unjudged()
                  : periodic          ? of_point
                  : cyclic.any()      ? reducedStability(l, cyclic)
                  : dynamics.linear() ? stabilityWithRigidBodyModes(l, cyclic)
                                      : whirl_twin::stability(l);
    }
    return *stability;
  }

  const std::vector<CriticalSpeed>& criticalSpeedsOf(const BuiltSystem& system) {
    if (!critical_speeds) {
      critical_speeds = criticalSpeeds(*heldDynamics(system));
    }
    return *critical_speeds;
  }
};

AnalysedScene::AnalysedScene(const BuiltScene& scene, std::optional<double> speed)
    : scene_(scene), speed_(speed), results_(scene.systems.size()) {}

AnalysedScene::~AnalysedScene() = default;

double AnalysedScene::value(const AnalysedNumber& number) {
  const BuiltSystem& system = *scene_.systems[number.system];
  Results& known = results_[number.system];
  const ShaftMotion shaft = scene_.driveOf(system).at(0.0);
  const double speed = speed_.value_or(shaft.speed);
  const EvaluationPoint<double> start{scene_.startSeconds(), shaft.angle, speed,
                                      speed_ ? 0.0 : shaft.acceleration};
  const auto at = [&](const std::vector<double>& list) {
    return number.place < list.size() ? list[number.place] : kNaN;
  };
  switch (number.kind) {
    case NumberKind::kNaturalFrequency:
      return at(known.stabilityOf(system, speed, start).natural_frequencies);
    case NumberKind::kDampingRatioOfMode:
      return at(known.stabilityOf(system, speed, start).damping_ratios);
    case NumberKind::kDecayRate:
      return known.stabilityOf(system, speed, start).decay_rate;
    case NumberKind::kDampingRatio:
      return known.stabilityOf(system, speed, start).damping_ratio;
    case NumberKind::kLogDecrement:
      return known.stabilityOf(system, speed, start).log_decrement;
    case NumberKind::kInstabilitySpeed:
      if (!known.instability_speed) {
        static_cast<void>(known.linearizationOf(system, speed, start));
        known.instability_speed =
            known.judged
                ? instabilitySpeed(*known.dynamics_judged, known.about, speed).value_or(kInfinity)
                : kNaN;
      }
      return *known.instability_speed;
    default:
      break;
  }
  const std::vector<CriticalSpeed>& critical_speeds = known.criticalSpeedsOf(system);
  if (number.kind == NumberKind::kSeparationReserve) {
    double least = kInfinity;  // without critical speed any distance is sufficient
    for (const CriticalSpeed& critical : critical_speeds) {
      const double factor = critical.amplification_factor;
      const double asked = requiredSeparationMargin(speed, critical.speed, factor);
      const double reserve = separationMargin(speed, critical.speed) - asked;
      if (std::isnan(reserve)) {
        return kNaN;
      }
      least = std::min(least, reserve);
    }
    return least;
  }
  if (number.place >= critical_speeds.size()) {
    return kNaN;
  }
  const CriticalSpeed& critical = critical_speeds[number.place];
  return number.kind == NumberKind::kCriticalSpeed ? critical.speed
         : number.kind == NumberKind::kAmplificationFactor
             ? critical.amplification_factor
             : separationMargin(speed, critical.speed);
}

}  // namespace whirl_twin
