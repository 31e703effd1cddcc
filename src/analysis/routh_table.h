// Routh's table as written by hand, with every row and the handling of special cases:
//
//   row_i[j] = row_{i-2}[j+1] - (row_{i-2}[0] / row_{i-1}[0]) row_{i-1}[j+1]
//
// (E. J. Routh, A Treatise on the Stability of a Given State of Motion, 1877). Entries are exact,
// and may have one symbol in them. For counting the roots right of the axis use routh.h, which is
// many times faster and gives the same first column.
#pragma once

#include <string>
#include <vector>

#include "analysis/exact_number.h"
#include "analysis/routh.h"
#include "analysis/symbolic_polynomial.h"

namespace whirl_twin {

// Routh's conditions in the form of the lecture notes, for s^n + A_(n-1) s^(n-1) + ... + A_0: every
// motion dies out if and only if all A_i > 0 and
//   cubic    A1 A2 > A0
//   quartic  A1 A2 A3 > A1^2 + A3^2 A0                    (the notes misprint A2^3 A0)
//   quintic  A3 A4 > A2,    (A3 A4 - A2)(A1 A2 - A0 A3) > (A1 A4 - A0)^2
//   sextic   A3 b1 > A5 b2, (A3 b1 - A5 b2)(A1 b2 - A3 b3) > (A1 b1 - A5 b3)^2
//            with b1 = A4 A5 - A3, b2 = A2 A5 - A1, b3 = A0 A5.
// The notes leave the last two to Routh's work ("two other requirements"): these are the Hurwitz
// determinants D2, D4 and D3, A5 D5 written out (Lienard and Chipart 1914).

constexpr int kMinConditionDegree = 1;
constexpr int kMaxConditionDegree = 6;

/// The conditions of a real polynomial of degree 1 to 6, highest power first, leading zeros
/// dropped: A0 > 0 ... first, then the others. It is asymptotically stable if and only if all hold,
/// in agreement with routh(). Throws InputError for any other degree or a coefficient that is not
/// finite.
std::vector<RouthCondition> routhConditions(const std::vector<Rational>& coefficients);
std::vector<RouthCondition> routhConditions(const std::vector<double>& coefficients);

struct RouthTableRow {
  int power = 0;  ///< of s, that its first entry belongs to
  std::vector<SymbolicQuotient> entry;
  std::string note;  ///< what was done to it, and why; "" by the rule
};

struct RouthTable {
  std::vector<RouthTableRow> rows;
  int zero_roots = 0;  ///< taken out first
};

/// Of coefficients highest power first. Leading zeros are dropped; a negative numeric leading
/// coefficient inverts all signs, as in routh(). An entry that contains the symbol is assumed
/// nonzero: where it is zero, the table is different. Throws InputError without a coefficient that
/// is not zero.
RouthTable routhTable(const std::vector<SymbolicPolynomial>& coefficients,
                      const std::string& symbol);

}  // namespace whirl_twin
