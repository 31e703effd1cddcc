#include "scene/ensemble_draw.h"

#include <fmt/format.h>

#include <boost/random/normal_distribution.hpp>
#include <boost/random/uniform_real_distribution.hpp>
#include <cmath>
#include <random>

#include "scene/node_reader.h"
#include "scene/parameter_paths.h"
#include "scene/spread_correlations.h"

namespace whirl_twin {

namespace {

constexpr int kMostDraws = 1000;

// The engine is the standard's, the same everywhere; its distributions are not, Boost's are.
double deviation(const Spread& spread, std::mt19937_64& random) {
  if (spread.normal) {
    return boost::random::normal_distribution<double>(0.0, spread.width)(random);
  }
  return boost::random::uniform_real_distribution<double>(-spread.width, spread.width)(random);
}

/// Puts one number into `member`; false: it is out of range.
bool put(const Spread& spread, double value, const ModelInfo& model, SystemSpec& member) {
  if (spread.kind != Spread::Kind::kParameter) {
    (spread.kind == Spread::Kind::kRate ? member.v : member.q)[spread.coordinate] = value;
    return std::isfinite(value);
  }
  Complaints complaints("");
  return setParameter(spread.path, value, model, member, complaints);
}

[[noreturn]] void refuseDraws(const std::string& what) {
  throw Refusal(
      fmt::format("{}: none of {} random draws is within the parameter's range", what, kMostDraws));
}

/// Number by number, each drawn again until it is in its range.
void drawApart(const SystemSpec& spec, const ModelInfo& model, std::mt19937_64& random,
               DrawnMember& member) {
  for (const Spread& spread : spec.ensemble.spread) {
    const double about = centreOf(spread, spec, model);
    double value = about + deviation(spread, random);
    int draws = 1;
    while (!put(spread, value, model, member.spec)) {
      if (++draws > kMostDraws) {
        refuseDraws(spread.path);
      }
      value = about + deviation(spread, random);
    }
    member.values.push_back(value);
  }
}

/// All of them drawn again until each is in its range.
void drawTogether(const SystemSpec& spec, const ModelInfo& model, std::mt19937_64& random,
                  DrawnMember& member) {
  const std::vector<Spread>& spreads = spec.ensemble.spread;
  std::size_t outside = 0;
  for (int draws = 0; draws < kMostDraws; ++draws) {
    std::vector<double> independent;
    for (const Spread& spread : spreads) {
      independent.push_back(deviation(spread, random));
    }
    member.values = correlated(spec.ensemble, independent);
    std::size_t i = 0;
    for (; i < spreads.size(); ++i) {
      member.values[i] += centreOf(spreads[i], spec, model);
      if (!put(spreads[i], member.values[i], model, member.spec)) {
        outside = i;
        break;
      }
    }
    if (i == spreads.size()) {
      return;
    }
  }
  refuseDraws(spreads[outside].path);
}

}  // namespace

double centreOf(const Spread& spread, const SystemSpec& spec, const ModelInfo& model) {
  switch (spread.kind) {
    case Spread::Kind::kCoordinate:
      return spec.q[spread.coordinate];
    case Spread::Kind::kRate:
      return spec.v[spread.coordinate];
    default:
      return parameterAt(spread.path, model, spec).value();
  }
}

DrawnMember drawnMember(const SystemSpec& spec, const ModelInfo& model, std::size_t index) {
  DrawnMember member{spec, {}};
  member.spec.ensemble = {};
  std::seed_seq seed{spec.ensemble.seed, static_cast<std::uint32_t>(index)};
  std::mt19937_64 random(seed);
  if (spec.ensemble.factor.size() == 0) {
    drawApart(spec, model, random, member);
  } else {
    drawTogether(spec, model, random, member);
  }
  return member;
}

std::optional<SystemSpec> memberAt(const SystemSpec& spec, const ModelInfo& model,
                                   const std::vector<double>& values) {
  SystemSpec member = spec;
  member.ensemble = {};
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!put(spec.ensemble.spread[i], values[i], model, member)) {
      return std::nullopt;
    }
  }
  return member;
}

std::string spreadObjection(const SystemSpec& spec, const ModelInfo& model) {
  try {
    static_cast<void>(drawnMember(spec, model, 0));
  } catch (const Refusal& error) {
    return error.what();
  }
  return "";
}

}  // namespace whirl_twin
