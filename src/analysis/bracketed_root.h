// A root between two places where a function has opposite signs: algorithm 748 (G. Alefeld, F.
// Potra, Y. Shi, ACM Trans. Math. Software 21, 1995), about ten evaluations where bisection takes
// fifty.
#pragma once

#include <functional>

namespace whirl_twin {

/// f(low) and f(high), given, differ in sign. Exact to a few units in the last place of the root.
double bracketedRoot(const std::function<double(double)>& f, double low, double high, double f_low,
                     double f_high);

}  // namespace whirl_twin
