#include "plots/thinning.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <unordered_set>
#include <utility>

namespace whirl_twin {
namespace {

constexpr double kUnseen = 0.12;      // px, maximum deviation of a line
constexpr double kCoarsest = 0.9;     // px, the same if there would be too many points
constexpr double kColumnWidth = 0.5;  // px
constexpr double kCell = 0.75;        // px, less than the width of a line

bool runsForward(const std::vector<Spot>& line) {
  return std::is_sorted(line.begin(), line.end(),
                        [](const Spot& a, const Spot& b) { return a.x < b.x; });
}

/// For a line from left to right: first, lowest, highest and last point of every pixel column.
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

/// Douglas-Peucker: a section whose points are all within `tolerance` of its chord is replaced by
/// it.
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

/// The cells of a fine raster that a section passes through.
std::vector<std::uint64_t> cellsOf(const Spot& from, const Spot& to, double size) {
  constexpr double kMaxSteps = 1.0e5;  // for a section that leads far beyond any sheet
  const double length = std::hypot(to.x - from.x, to.y - from.y);
  const int steps = 1 + static_cast<int>(std::min(2.0 * length / size, kMaxSteps));
  const auto cellAt = [size](double place) {
    constexpr double kFarthest = 2.0e9;
    return static_cast<std::int32_t>(std::clamp(std::floor(place / size), -kFarthest, kFarthest));
  };
  std::vector<std::uint64_t> cells;
  for (int i = 0; i <= steps; ++i) {
    const double s = static_cast<double>(i) / steps;
    const std::int32_t column = cellAt(from.x + s * (to.x - from.x));
    const std::int32_t row = cellAt(from.y + s * (to.y - from.y));
    cells.push_back(static_cast<std::uint64_t>(static_cast<std::uint32_t>(column)) << 32U |
                    static_cast<std::uint32_t>(row));
  }
  return cells;
}

/// Sections through the same cells [px] count as equal.
std::vector<std::vector<Spot>> withoutRepeats(const std::vector<Spot>& line, double cell) {
  std::unordered_set<std::uint64_t> drawn;
  std::vector<std::vector<Spot>> pieces;
  bool drawing = false;
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    const std::vector<std::uint64_t> cells = cellsOf(line[i], line[i + 1], cell);
    std::size_t fresh = 0;
    for (const std::uint64_t one : cells) {
      fresh += drawn.insert(one).second ? 1 : 0;
    }
    if (10 * fresh <= cells.size()) {
      drawing = false;
      continue;
    }
    if (!drawing) {
      pieces.push_back({line[i]});
      drawing = true;
    }
    pieces.back().push_back(line[i + 1]);
  }
  return pieces;
}

}  // namespace

std::vector<std::vector<Spot>> withoutRepeats(const std::vector<Spot>& line, std::size_t most) {
  double tolerance = kUnseen;
  double cell = kCell;
  for (;;) {
    std::vector<std::vector<Spot>> pieces = withoutRepeats(simplified(line, tolerance), cell);
    std::size_t spots = 0;
    for (const std::vector<Spot>& piece : pieces) {
      spots += piece.size();
    }
    if (spots <= std::max<std::size_t>(most, 2)) {
      return pieces;
    }
    if (tolerance < kCoarsest) {
      tolerance *= 2.0;
    } else {
      cell *= 1.5;
    }
  }
}

std::vector<Spot> thinned(const std::vector<Spot>& line) {
  if (line.size() < 3) {
    return line;
  }
  return simplified(runsForward(line) ? thinnedByColumns(line) : line, kUnseen);
}

}  // namespace whirl_twin
