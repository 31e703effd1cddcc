#include "plots/thinning.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace whirl_twin {
namespace {

constexpr double kUnseen = 0.12;      // px, by which a line may be off
constexpr double kColumnWidth = 0.5;  // px

bool runsForward(const std::vector<Spot>& line) {
  return std::is_sorted(line.begin(), line.end(),
                        [](const Spot& a, const Spot& b) { return a.x < b.x; });
}

/// Of a line that runs from left to right: first, lowest, highest and last point of every column.
std::vector<Spot> thinnedByColumns(const std::vector<Spot>& line) {
  std::vector<Spot> kept;
  const auto above = [](const Spot& a, const Spot& b) { return a.y < b.y; };
  for (auto begin = line.begin(); begin != line.end();) {
    const double column = std::floor(begin->x / kColumnWidth);
    const auto end = std::find_if(begin, line.end(), [column](const Spot& spot) {
      return std::floor(spot.x / kColumnWidth) != column;
    });
    auto [first, second] = std::minmax_element(begin, end, above);
    if (second < first) {
      std::swap(first, second);
    }
    const auto last = end - 1;
    kept.push_back(*begin);
    for (const auto& spot : {first, second, last}) {
      if (spot->x != kept.back().x || spot->y != kept.back().y) {
        kept.push_back(*spot);
      }
    }
    begin = end;
  }
  return kept;
}

double distance(const Spot& p, const Spot& a, const Spot& b) {
  const double dx = b.x - a.x;
  const double dy = b.y - a.y;
  const double length2 = dx * dx + dy * dy;
  const double along =
      length2 > 0.0 ? std::clamp(((p.x - a.x) * dx + (p.y - a.y) * dy) / length2, 0.0, 1.0) : 0.0;
  return std::hypot(p.x - a.x - along * dx, p.y - a.y - along * dy);
}

/// Douglas and Peucker: a stretch whose points are all within `tolerance` of its chord becomes it.
std::vector<Spot> simplified(const std::vector<Spot>& line, double tolerance) {
  std::vector<char> keep(line.size(), 0);
  keep.front() = keep.back() = 1;
  std::vector<std::pair<std::size_t, std::size_t>> stretches{{0, line.size() - 1}};
  while (!stretches.empty()) {
    const auto [first, last] = stretches.back();
    stretches.pop_back();
    double farthest = tolerance;
    std::size_t split = first;
    for (std::size_t i = first + 1; i < last; ++i) {
      const double d = distance(line[i], line[first], line[last]);
      if (d > farthest) {
        farthest = d;
        split = i;
      }
    }
    if (split != first) {
      keep[split] = 1;
      stretches.emplace_back(first, split);
      stretches.emplace_back(split, last);
    }
  }
  std::vector<Spot> kept;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (keep[i] != 0) {
      kept.push_back(line[i]);
    }
  }
  return kept;
}

}  // namespace

std::vector<Spot> thinned(const std::vector<Spot>& line, std::size_t most) {
  if (line.size() < 3) {
    return line;
  }
  std::vector<Spot> kept = runsForward(line) ? thinnedByColumns(line) : line;
  kept = simplified(kept, kUnseen);
  for (double tolerance = 2.0 * kUnseen; kept.size() > std::max<std::size_t>(most, 2);
       tolerance *= 2.0) {
    kept = simplified(kept, tolerance);
  }
  return kept;
}

}  // namespace whirl_twin
