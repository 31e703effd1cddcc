// Thinning of lines: removes points below the resolution of a screen.
#pragma once

#include <cstddef>
#include <vector>

namespace whirl_twin {

/// A point in a picture [px], x to the right, y downwards.
struct Spot {
  double x = 0.0, y = 0.0;
};

/// The line with only the points needed to stay within a fraction of a pixel of the given one. The
/// ends are kept.
std::vector<Spot> thinned(const std::vector<Spot>& line);

/// Removes the stretches of a line that repeat what it has drawn before: a periodic motion draws
/// the same loop again and again. The line is coarsened, by a pixel at most, and the tolerance of
/// equality grows, until at most `most` points remain.
std::vector<std::vector<Spot>> withoutRepeats(const std::vector<Spot>& line, std::size_t most);

}  // namespace whirl_twin
