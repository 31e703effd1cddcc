// Fewer points for the same line: what a screen cannot show need not be in a file.
#pragma once

#include <cstddef>
#include <vector>

namespace whirl_twin {

/// A place in a picture [px], x to the right, y downwards.
struct Spot {
  double x = 0.0, y = 0.0;
};

/// A line with every point that is needed to stay within a fraction of a pixel of the given one,
/// or, if these are more than `most`, within as little more as it takes. The ends stay.
std::vector<Spot> thinned(const std::vector<Spot>& line, std::size_t most);

}  // namespace whirl_twin
