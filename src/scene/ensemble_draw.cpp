#include "scene/ensemble_draw.h"

#include <fmt/format.h>

#include <algorithm>
#include <boost/random/normal_distribution.hpp>
#include <boost/random/uniform_real_distribution.hpp>
#include <cmath>
#include <random>

#include "scene/node_reader.h"
#include "scene/parameter_paths.h"

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

bool isSpread(const SystemSpec& spec, const std::string& path) {
  return std::any_of(spec.ensemble.spread.begin(), spec.ensemble.spread.end(),
                     [&](const Spread& s) { return s.path == path; });
}

/// Draws one number into `member`; false: it is out of range.
bool draw(const Spread& spread, const ModelInfo& model, std::mt19937_64& random, SystemSpec& member,
          double& value) {
  const double away = deviation(spread, random);
  if (spread.kind != Spread::Kind::kParameter) {
    std::vector<double>& start = spread.kind == Spread::Kind::kRate ? member.v : member.q;
    value = start[spread.coordinate] += away;
    return std::isfinite(value);
  }
  value = parameterAt(spread.path, model, member).value() + away;
  Complaints complaints("");
  return setParameter(spread.path, value, model, member, complaints);
}

}  // namespace

DrawnMember drawnMember(const SystemSpec& spec, const ModelInfo& model, std::size_t index) {
  DrawnMember member{spec, {}};
  member.spec.ensemble = {};
  std::seed_seq seed{spec.ensemble.seed, static_cast<std::uint32_t>(index)};
  std::mt19937_64 random(seed);
  for (const Spread& spread : spec.ensemble.spread) {
    double value = 0.0;
    int draws = 1;
    while (!draw(spread, model, random, member.spec, value)) {
      if (++draws > kMostDraws) {
        throw Refusal(fmt::format("{}: not one of {} draws is in the number's range", spread.path,
                                  kMostDraws));
      }
    }
    member.values.push_back(value);
  }
  for (const ParameterInfo& p : model.parameters) {
    const std::string& source = p.fallback_parameter;
    if (!source.empty() && !isSpread(spec, p.name) &&
        spec.parameters.at(p.name) == spec.parameters.at(source)) {
      member.spec.parameters[p.name] = member.spec.parameters.at(source);
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
