// Fewer points for the same line: what a screen cannot show need not be in a file.
#pragma once

#include <cstddef>
#include <vector>

namespace whirl_twin {

/// A place in a picture [px], x to the right, y downwards.
struct Spot {
  double x = 0.0, y = 0.0;
};

/// A line with every point that is needed to stay within a fraction of a pixel of the given one.
/// The ends stay.
std::vector<Spot> thinned(const std::vector<Spot>& line);

/// What is left of a line without the stretches that run over what it has drawn before: a motion
/// that repeats itself draws the same loop again and again. The line is coarsened, by a pixel at
/// most, and what counts as the same grows, until at most `most` points are left.
std::vector<std::vector<Spot>> withoutRepeats(const std::vector<Spot>& line, std::size_t most);

}  // namespace whirl_twin
