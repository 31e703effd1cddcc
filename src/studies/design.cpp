#include "studies/design.h"

#include <Random123/philox.h>

#include <algorithm>
#include <boost/random/sobol.hpp>
#include <cmath>
#include <memory>

namespace whirl_twin {

namespace {

constexpr double kPer53Bits = 1.0 / 9007199254740992.0;  // 2^-53

/// Purpose of a draw: each has a separate stream.
enum Stream : std::uint32_t { kValues, kWithin, kStrata, kOrder, kScrambling };

/// 64 random bits from the seed, the purpose, the index of a number and that of a point.
std::uint64_t bits(std::uint32_t seed, Stream stream, std::size_t number, std::uint64_t point) {
  const r123::Philox4x32::ctr_type counter{{static_cast<std::uint32_t>(point),
                                            static_cast<std::uint32_t>(point >> 32U),
                                            static_cast<std::uint32_t>(number), 0U}};
  const r123::Philox4x32::ctr_type words =
      r123::Philox4x32{}(counter, r123::Philox4x32::key_type{{seed, stream}});
  return (static_cast<std::uint64_t>(words[0]) << 32U) | words[1];
}

/// Midpoint of the interval given by the upper 52 bits: never 0, never 1.
double uniform(std::uint64_t random) {
  return static_cast<double>(((random >> 12U) << 1U) | 1U) * kPer53Bits;
}

/// Number of bits for all numbers below count.
unsigned widthOf(std::uint64_t count) {
  unsigned width = 0;
  while (width < 64 && ((count - 1) >> width) != 0) {
    ++width;
  }
  return width;
}

/// Owen's scrambling of a coordinate: each bit is flipped by a random bit that depends on all bits
/// above it. Six bits at a time; their 63 random bits are from one draw, numbered as the nodes of a
/// binary tree from 1 on. Sequences of up to 2^36 points have equal bits below these: there the
/// output is random.
std::uint64_t scrambled(std::uint64_t x, std::uint32_t seed, std::size_t number,
                        std::uint32_t replicate) {
  constexpr unsigned kGroup = 6, kGroups = 6;
  const auto drawn = [&](std::uint64_t above, unsigned group) {
    const r123::Philox4x32::ctr_type words = r123::Philox4x32{}(
        r123::Philox4x32::ctr_type{{static_cast<std::uint32_t>(above),
                                    static_cast<std::uint32_t>(above >> 32U) | group << 8U,
                                    static_cast<std::uint32_t>(number), replicate}},
        r123::Philox4x32::key_type{{seed, kScrambling}});
    return (static_cast<std::uint64_t>(words[0]) << 32U) | words[1];
  };
  std::uint64_t out = 0;
  for (unsigned group = 0; group < kGroups; ++group) {
    const std::uint64_t turned = drawn(group == 0 ? 0 : x >> (64 - kGroup * group), group);
    std::uint64_t node = 1;
    for (unsigned k = kGroup * group; k < kGroup * (group + 1); ++k) {
      const std::uint64_t bit = x >> (63 - k) & 1U;
      out |= (bit ^ (turned >> node & 1U)) << (63 - k);
      node = 2 * node + bit;
    }
  }
  return out | drawn(x >> (64 - kGroup * kGroups), kGroups) >> (kGroup * kGroups);
}

std::vector<double> latinHypercube(const Design& design, std::uint32_t seed, std::uint64_t point) {
  std::vector<double> u(design.dimensions);
  const auto strata = static_cast<double>(design.points);
  for (std::size_t j = 0; j < u.size(); ++j) {
    const std::uint64_t stratum = permuted(point, design.points, bits(seed, kStrata, j, 0));
    const auto low = static_cast<double>(stratum);
    // Rounding must not move a point out of its stratum, (s + v) / n with 0 < v < 1.
    u[j] = std::clamp((low + uniform(bits(seed, kWithin, j, point))) / strata,
                      std::nextafter(low / strata, 1.0), std::nextafter((low + 1.0) / strata, 0.0));
  }
  return u;
}

std::vector<double> monteCarlo(const Design& design, std::uint32_t seed, std::uint64_t point) {
  std::vector<double> u(design.dimensions);
  for (std::size_t j = 0; j < u.size(); ++j) {
    u[j] = uniform(bits(seed, kValues, j, point));
  }
  return u;
}

/// Row of A, of B, or of A with one number from B.
std::vector<double> sobolIndices(const Design& design, std::uint32_t seed, std::uint64_t point) {
  const std::size_t d = design.dimensions;
  const std::uint64_t row = point / (d + 2);
  const std::uint64_t which = point % (d + 2);
  const std::uint64_t parts = replicates(design.base);
  const std::vector<double> both =
      sobolPoint(2 * d, row / parts, seed, static_cast<std::uint32_t>(row % parts));
  const auto half = both.begin() + static_cast<std::ptrdiff_t>(d);
  std::vector<double> u(which == 1 ? half : both.begin(), which == 1 ? both.end() : half);
  if (which >= 2) {
    u[which - 2] = both[d + which - 2];
  }
  return u;
}

std::vector<double> morris(const Design& design, std::uint32_t seed, std::uint64_t point) {
  const std::size_t d = design.dimensions;
  const std::uint64_t trajectory = point / (d + 1);
  const std::uint64_t along = point % (d + 1);
  const std::size_t p = design.levels.front();
  std::vector<std::size_t> level(d);
  const std::vector<MorrisStep> steps = morrisSteps(design, seed, trajectory);
  for (const MorrisStep& step : steps) {
    // The start allows for the single step up or down.
    level[step.number] = bits(seed, kValues, step.number, trajectory) % (p / 2);
    level[step.number] += step.up ? 0 : p / 2;
  }
  for (std::uint64_t k = 0; k < along; ++k) {
    const MorrisStep& step = steps[k];
    level[step.number] = step.up ? level[step.number] + p / 2 : level[step.number] - p / 2;
  }
  std::vector<double> u(d);
  for (std::size_t j = 0; j < d; ++j) {
    u[j] = (static_cast<double>(level[j]) + 0.5) / static_cast<double>(p);
  }
  return u;
}

}  // namespace

const std::vector<std::string>& designNames() {
  static const std::vector<std::string> names{
      "grid",  "list",          "one_at_a_time", "monte_carlo", "latin_hypercube",
      "sobol", "sobol_indices", "morris"};
  return names;
}

const std::string& name(Design::Kind kind) {
  return designNames()[static_cast<std::size_t>(kind)];
}

std::uint64_t permuted(std::uint64_t place, std::uint64_t count, std::uint64_t key) {
  if (count < 2) {
    return place;
  }
  // Four Feistel rounds on two halves of an even number of bits, repeated until the result is below
  // count: fewer than four times on average.
  const unsigned half = (widthOf(count) + 1) / 2;
  const std::uint64_t mask = (std::uint64_t{1} << half) - 1;
  do {
    std::uint64_t left = place >> half;
    std::uint64_t right = place & mask;
    for (std::uint32_t round = 0; round < 4; ++round) {
      const r123::Philox2x32::ctr_type words = r123::Philox2x32{}(
          r123::Philox2x32::ctr_type{
              {static_cast<std::uint32_t>(right), static_cast<std::uint32_t>(key >> 32U) ^ round}},
          r123::Philox2x32::key_type{{static_cast<std::uint32_t>(key)}});
      const std::uint64_t next = left ^ (words[0] & mask);
      left = right;
      right = next;
    }
    place = (left << half) | right;
  } while (place >= count);
  return place;
}

std::vector<double> sobolPoint(std::size_t dimensions, std::uint64_t point, std::uint32_t seed,
                               std::uint32_t replicate) {
  // Cached: the table of direction numbers takes longer than a thousand points. Boost's sequence
  // starts after the origin.
  thread_local std::unique_ptr<boost::random::sobol> sequence;
  thread_local std::uint64_t next = 0;
  if (!sequence || sequence->dimension() != dimensions) {
    sequence = std::make_unique<boost::random::sobol>(dimensions);
    next = 1;
  }
  if (point > 0 && point != next) {
    sequence->seed(point - 1);
  }
  next = point > 0 ? point + 1 : next;
  std::vector<double> u(dimensions);
  for (std::size_t j = 0; j < dimensions; ++j) {
    u[j] = uniform(scrambled(point > 0 ? (*sequence)() : 0, seed, j, replicate));
  }
  return u;
}

std::uint64_t replicates(std::uint64_t base) {
  constexpr std::uint64_t kMost = 16, kMinPoints = 16;
  return std::clamp<std::uint64_t>(base / kMinPoints, 2, kMost);
}

double morrisStride(const Design& design) {
  const std::size_t p = design.levels.front();
  return static_cast<double>(p / 2) / static_cast<double>(p);
}

std::vector<MorrisStep> morrisSteps(const Design& design, std::uint32_t seed,
                                    std::uint64_t trajectory) {
  std::vector<MorrisStep> steps(design.dimensions);
  for (std::size_t j = 0; j < steps.size(); ++j) {
    steps[j].number = j;
  }
  for (std::size_t j = steps.size(); j-- > 1;) {  // Fisher & Yates
    std::swap(steps[j].number, steps[bits(seed, kOrder, j, trajectory) % (j + 1)].number);
  }
  for (MorrisStep& step : steps) {
    step.up = (bits(seed, kWithin, step.number, trajectory) & 1U) != 0;
  }
  return steps;
}

std::vector<double> quantilesAt(const Design& design, std::uint32_t seed, std::uint64_t point) {
  switch (design.kind) {
    case Design::Kind::kLatinHypercube:
      return latinHypercube(design, seed, point);
    case Design::Kind::kSobol:
      return sobolPoint(design.dimensions, point, seed);
    case Design::Kind::kSobolIndices:
      return sobolIndices(design, seed, point);
    case Design::Kind::kMorris:
      return morris(design, seed, point);
    default:
      return monteCarlo(design, seed, point);
  }
}

std::vector<std::optional<std::size_t>> levelsAt(const Design& design, std::uint64_t point) {
  std::vector<std::optional<std::size_t>> level(design.dimensions);
  if (design.kind == Design::Kind::kList) {
    std::fill(level.begin(), level.end(), static_cast<std::size_t>(point));
    return level;
  }
  if (design.kind == Design::Kind::kOneAtATime) {
    std::uint64_t left = point;
    for (std::size_t j = 0; j < level.size() && left > 0; ++j) {
      if (left <= design.levels[j]) {
        level[j] = static_cast<std::size_t>(left - 1);
        break;
      }
      left -= design.levels[j];
    }
    return level;
  }
  for (std::size_t j = level.size(); j-- > 0;) {
    level[j] = static_cast<std::size_t>(point % design.levels[j]);
    point /= design.levels[j];
  }
  return level;
}

}  // namespace whirl_twin
