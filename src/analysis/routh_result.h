// What Routh's test says of a polynomial (routh.h, routh_conditions.h), without the exact numbers
// that it takes to say it.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace whirl_twin {

enum class Verdict : std::uint8_t {
  kAsymptoticallyStable = 0,  ///< every root left of the imaginary axis
  kMarginal,                  ///< none right of it, some on it, all of those simple
  kRepeatedImaginary,         ///< none right of it, a repeated one on it
  kUnstable,                  ///< at least one right of it
  kUncertain                  ///< cannot be told from the numbers at hand; never said by routh()
};

/// "asymptotically_stable", "marginal", "repeated_imaginary", "unstable" or "uncertain".
const char* name(Verdict verdict);

struct RouthResult {
  Verdict verdict = Verdict::kAsymptoticallyStable;
  int right = 0;
  int imaginary = 0;  ///< every root on the imaginary axis, zeros included
  int left = 0;
  int largest_imaginary_multiplicity = 0;
  /// Real coefficients: the first column of Routh's table of the polynomial divided by its roots at
  /// zero, times -1 if its leading coefficient is negative; its sign changes are the right roots.
  /// Complex ones: the leading coefficients of the Sturm sequence, each times (-1)^(n - degree). In
  /// the regular case (n + 1 entries) their sign changes are the right roots, and for a real
  /// polynomial they are the column above; a shorter column means roots on the axis or in pairs
  /// symmetric to it, or a degree that dropped by more than one.
  std::vector<double> first_column;
};

/// One inequality left > right of the coefficients.
struct RouthCondition {
  std::string name;    ///< "A1 A2 > A0"
  double left = 0.0;   ///< rounded
  double right = 0.0;  ///< rounded
  bool holds = false;  ///< exact
};

}  // namespace whirl_twin
