#include "plots/label_places.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace whirl_twin {
namespace {

/// Does the line segment intersect the area? (Liang and Barsky, 1984.)
bool crosses(const Spot& from, const Spot& to, const Rectangle& area) {
  double enters = 0.0, leaves = 1.0;
  const auto cut = [&](double start, double along, double low, double high) {
    if (along == 0.0) {
      return start >= low && start <= high;
    }
    const double a = (low - start) / along;
    const double b = (high - start) / along;
    enters = std::max(enters, std::min(a, b));
    leaves = std::min(leaves, std::max(a, b));
    return enters <= leaves;
  };
  return cut(from.x, to.x - from.x, area.left, area.right()) &&
         cut(from.y, to.y - from.y, area.top, area.bottom());
}

bool overlap(const Rectangle& a, const Rectangle& b) {
  return a.left < b.right() && b.left < a.right() && a.top < b.bottom() && b.top < a.bottom();
}

}  // namespace

Rectangle LabelPlaces::take(const std::vector<Rectangle>& places) {
  Rectangle best = places.front();
  int least = std::numeric_limits<int>::max();
  for (const Rectangle& place : places) {
    const int now = covered(place);
    if (now < least) {
      least = now;
      best = place;
    }
    if (least == 0) {
      break;
    }
  }
  areas_.push_back(best);
  return best;
}

/// Amount of overlap; the edge of the sheet counts as a hundred lines.
int LabelPlaces::covered(const Rectangle& place) const {
  const bool inside = place.left >= sheet_.left && place.right() <= sheet_.right() &&
                      place.top >= sheet_.top && place.bottom() <= sheet_.bottom();
  int count = inside ? 0 : 100;
  for (const Rectangle& area : areas_) {
    count += overlap(place, area) ? 10 : 0;
  }
  for (const std::vector<Spot>& line : lines_) {
    for (std::size_t i = 0; i + 1 < line.size(); ++i) {
      const Spot& from = line[i];
      const Spot& to = line[i + 1];
      if (std::isfinite(from.x + from.y + to.x + to.y) && crosses(from, to, place)) {
        ++count;
      }
    }
  }
  return count;
}

}  // namespace whirl_twin
