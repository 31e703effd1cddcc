// Routh's table as it is written by hand, with every row and what was done where the rule fails:
//
//   row_i[j] = row_{i-2}[j+1] - (row_{i-2}[0] / row_{i-1}[0]) row_{i-1}[j+1]
//
// (E. J. Routh, A Treatise on the Stability of a Given State of Motion, 1877). Entries are exact,
// and may have one symbol in them. Whether roots are right of the axis is routh.h's to say, which
// is many times faster and gives the same first column.
#pragma once

#include <string>
#include <vector>

#include "analysis/symbolic_polynomial.h"

namespace whirl_twin {

struct RouthTableRow {
  int power = 0;  ///< of s, that its first entry belongs to
  std::vector<SymbolicQuotient> entry;
  std::string note;  ///< what was done to it, and why; "" by the rule
};

struct RouthTable {
  std::vector<RouthTableRow> rows;
  int zero_roots = 0;  ///< taken out first
};

/// Of coefficients highest power first. Leading zeros are dropped; what is a number and negative in
/// front turns all signs, as in routh(). An entry that holds the symbol is taken for not zero:
/// where it is, the table is another one. Throws Refusal without a coefficient that is not zero.
RouthTable routhTable(const std::vector<SymbolicPolynomial>& coefficients,
                      const std::string& symbol);

}  // namespace whirl_twin
