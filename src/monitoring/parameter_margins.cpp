#include "monitoring/parameter_margins.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>

#include "analysis/stability.h"
#include "scene/driven_dynamics.h"
#include "scene/parameter_paths.h"
#include "scene/system_setup.h"

namespace whirl_twin {

namespace {

constexpr char kSpeed[] = "speed";
constexpr double kZerosFirst = 1.0e-3;  // of the largest number of its unit
constexpr double kZerosStride = 1.25;
constexpr double kVanished = 1.0e-3;  // of a number: the last stride before zero

/// A number of the system, and what it makes of it.
struct Candidate {
  std::string parameter;
  std::string unit;
  double value = 0.0;
  SystemOfNumber system;
};

/// With one number changed, and those that follow it.
SystemOfNumber withNumber(const BuiltSystem& system, const std::string& path, double speed) {
  return [&system, path, speed](double value) -> std::optional<SystemAtNumber> {
    SystemSpec spec = system.spec;
    Diagnostics diagnostics("");
    if (!setParameter(path, value, *system.model, spec, diagnostics)) {
      return std::nullopt;
    }
    try {
      auto dynamics = judgedDynamics(
          system.model->setUp(spec.parameters, spec.settings, spec.setup->around).dynamics, spec);
      if (dynamics->dof() != system.dynamics->dof()) {  // a system of another kind
        return std::nullopt;
      }
      return SystemAtNumber{std::move(dynamics), speed};
    } catch (const std::exception&) {  // numbers that do not fit together
      return std::nullopt;
    }
  };
}

SystemOfNumber withSpeed(const BuiltSystem& system) {
  return [dynamics = judgedDynamics(system.dynamics, system.spec)](
             double speed) -> std::optional<SystemAtNumber> {
    return SystemAtNumber{dynamics, speed};
  };
}

std::vector<Candidate> candidates(const BuiltSystem& system, double speed) {
  std::vector<Candidate> all;
  const state::ParameterChange numbers = system.parameters();
  for (std::size_t i = 0; i < numbers.names.size(); ++i) {
    all.push_back({numbers.names[i], unitAt(numbers.names[i], *system.model, system.spec),
                   numbers.values[i], withNumber(system, numbers.names[i], speed)});
  }
  if (system.dynamics->hasShaft() && speed != 0.0) {
    all.push_back({kSpeed, "rad/s", speed, withSpeed(system)});
  }
  return all;
}

/// Changes of a number in parts of it, going down from 0, through -1 where it vanishes.
std::vector<double> downward(const MarginResolution& resolution, bool through_zero) {
  std::vector<double> changes;
  const int strides = static_cast<int>(std::lround(1.0 / resolution.stride));
  for (int i = 1; i < strides; ++i) {
    changes.push_back(-i * resolution.stride);
  }
  for (const double rest : {0.01, kVanished, 0.0}) {
    changes.push_back(rest - 1.0);
  }
  if (through_zero) {
    const std::vector<double> near = changes;
    for (auto change = near.rbegin() + 1; change != near.rend(); ++change) {
      changes.push_back(-2.0 - *change);
    }
    for (double part = 1.0; part <= resolution.reach; part *= 1.0 + resolution.stride) {
      changes.push_back(-1.0 - part);
    }
  }
  return changes;
}

std::vector<double> upward(const MarginResolution& resolution) {
  std::vector<double> changes;
  for (double part = 1.0; part < resolution.reach;) {
    part *= 1.0 + resolution.stride;
    changes.push_back(part - 1.0);
  }
  return changes;
}

/// The values that changes up to `limit` lead to.
std::vector<double> valuesOf(double value, const std::vector<double>& changes, double limit) {
  std::vector<double> values;
  for (const double change : changes) {
    values.push_back(value + value * std::copysign(std::fmin(std::fabs(change), limit), change));
    if (std::fabs(change) >= limit) {
      break;
    }
  }
  return values;
}

/// The smallest change of a number that is not zero to the loss, if it is below `limit` [-].
std::optional<ParameterMargin> marginOf(const Candidate& number, const SteadyMotion& motion,
                                        const MarginResolution& resolution, double limit) {
  // A shaft that turns the other way mirrors what it did.
  const bool through_zero = number.parameter != kSpeed;
  const std::vector<double> down = downward(resolution, through_zero);
  const std::vector<double> up = upward(resolution);
  const auto at = [&](double change) { return number.value * (1.0 + change); };
  if (isWithoutEffect(number.system, number.value, motion,
                      {at(down.front()), at(-0.99), at(up.front()), at(up.back())})) {
    return std::nullopt;
  }
  std::optional<ParameterMargin> nearest;
  for (const std::vector<double>* changes : {&down, &up}) {
    const auto loss =
        lossAlong(number.system, number.value, motion, valuesOf(number.value, *changes, limit));
    if (!loss) {
      continue;
    }
    const double change = (loss->value - number.value) / number.value;
    // Without it the system is another: a film that no speed feeds carries nothing.
    const bool vanished = loss->kind == LossKind::kNoMotion &&
                          std::fabs(loss->value) <= kVanished * std::fabs(number.value);
    if (std::fabs(change) < limit && !vanished) {
      limit = std::fabs(change);
      nearest = {number.parameter, number.unit, number.value, change, *loss};
    }
  }
  return nearest;
}

/// What others of its unit are; 0 where there are none. Entries of matrices have those of theirs.
double sizeBeside(const Candidate& zero, const std::vector<Candidate>& all) {
  const auto family = [](const Candidate& c) {
    return c.unit == "-" ? c.parameter.substr(0, c.parameter.find('[')) : c.unit;
  };
  double size = 0.0;
  for (const Candidate& other : all) {
    if (family(other) == family(zero)) {
      size = std::fmax(size, std::fabs(other.value));
    }
  }
  return size;
}

/// Of a number that is zero now.
std::optional<ParameterMargin> marginOfZero(const Candidate& number, double size,
                                            const SteadyMotion& motion) {
  std::optional<ParameterMargin> nearest;
  for (const double sign : {1.0, -1.0}) {
    std::vector<double> values;
    for (double part = kZerosFirst; part < 10.0 * kZerosStride; part *= kZerosStride) {
      values.push_back(sign * size * part);
    }
    if (isWithoutEffect(number.system, 0.0, motion, {values.front(), values.back()})) {
      continue;
    }
    const auto loss = lossAlong(number.system, 0.0, motion, values);
    if (loss && (!nearest || std::fabs(loss->value) < std::fabs(nearest->loss.value))) {
      nearest = {number.parameter, number.unit, 0.0, std::numeric_limits<double>::quiet_NaN(),
                 *loss};
    }
  }
  return nearest;
}

/// Numbers beyond the range of double on the way: none is known.
template <class Find>
std::optional<ParameterMargin> ifFinite(const Find& find) {
  try {
    return find();
  } catch (const std::exception&) {
    return std::nullopt;
  }
}

}  // namespace

MarginResolution marginResolution(const Dynamics& dynamics) {
  return dynamics.dof() <= kMaxExactCoordinates ? MarginResolution{} : MarginResolution{0.25, 4.0};
}

bool isQuickToSearch(const BuiltSystem& system) {
  const bool periodic = !judgedDynamics(system.dynamics, system.spec)->loadFrequencies().empty();
  return system.dynamics->dof() <= (periodic ? 1 : kMaxExactCoordinates) &&
         system.spec.settings.tables.empty();
}

std::vector<ParameterMargin> parameterMargins(const BuiltSystem& system, const SteadyMotion& motion,
                                              double speed) {
  const MarginResolution resolution = marginResolution(*system.dynamics);
  const std::vector<Candidate> numbers = candidates(system, speed);
  std::vector<ParameterMargin> all;
  for (const Candidate& number : numbers) {
    const auto margin = ifFinite([&] {
      if (number.value != 0.0) {
        return marginOf(number, motion, resolution, std::numeric_limits<double>::infinity());
      }
      const double size = sizeBeside(number, numbers);
      return size > 0.0 ? marginOfZero(number, size, motion) : std::nullopt;
    });
    if (margin) {
      all.push_back(*margin);
    }
  }
  std::stable_sort(all.begin(), all.end(), [](const ParameterMargin& a, const ParameterMargin& b) {
    return std::isnan(a.change) ? false
                                : std::isnan(b.change) || std::fabs(a.change) < std::fabs(b.change);
  });
  return all;
}

std::optional<ParameterMargin> nearestInstability(const BuiltSystem& system,
                                                  const SteadyMotion& motion, double speed,
                                                  const std::function<bool()>& given_up) {
  const MarginResolution resolution = marginResolution(*system.dynamics);
  std::optional<ParameterMargin> nearest;
  std::vector<Candidate> numbers = candidates(system, speed);
  for (Candidate& number : numbers) {
    number.system = [changed = number.system, &given_up](double value) {
      return given_up() ? std::nullopt : changed(value);
    };
    const double limit =
        nearest ? std::fabs(nearest->change) : std::numeric_limits<double>::infinity();
    const auto margin = number.value == 0.0
                            ? std::nullopt
                            : ifFinite([&] { return marginOf(number, motion, resolution, limit); });
    if (margin) {
      nearest = margin;
    }
  }
  return given_up() ? std::nullopt : nearest;
}

const char* lossName(LossKind kind, const Dynamics& dynamics) {
  switch (kind) {
    case LossKind::kFlutter:
      return dynamics.isRotor() ? "whirl" : "flutter";
    case LossKind::kNoMotion:
      return "no_motion";
    default:
      return "divergence";
  }
}

}  // namespace whirl_twin
