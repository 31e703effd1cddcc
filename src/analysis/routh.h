// The Routh-Hurwitz test, exact: how many roots of a polynomial lie right of, on and left of the
// imaginary axis, without computing any of them.
//
// Real coefficients: Routh's table (Routh 1877), row_i[j] = row_{i-2}[j+1] - (row_{i-2}[0] /
// row_{i-1}[0]) row_{i-1}[j+1], with both special cases made exact:
//  - a row that begins with m zeros: row += (-1)^m (row shifted left by m) (Benidir and Picinbono,
//    IEEE Trans. Automatic Control 35, 1990); no small number epsilon, which can miscount;
//  - a row of zeros: the derivative of the auxiliary polynomial, the row above, takes its place.
// Complex coefficients (isotropic rotors in z = x + i y): the generalised test of Frank (1946) and
// Bilharz (1944) as the Sturm sequence of Re and Im of p(jx)/j^n.
//
// What a polynomial cannot say: a repeated imaginary root grows like t^(m-1) unless the matrix it
// comes from is semisimple there, as an isotropic undamped rotor in x and y is.
#pragma once

#include <vector>

#include "analysis/exact_number.h"
#include "analysis/routh_result.h"

namespace whirl_twin {

/// Roots of a real polynomial, coefficients highest power first; leading zeros are dropped.
/// Exact for the numbers given, whatever their size. A non-zero constant is asymptotically stable.
/// Throws Refusal without a non-zero coefficient or with one that is not finite.
/// Not real-time safe (allocates).
RouthResult routh(const std::vector<Rational>& coefficients);
RouthResult routh(const std::vector<double>& coefficients);
/// The same as far as a budget goes: throws ExactBudgetSpent.
RouthResult routh(const std::vector<Rational>& coefficients, ExactBudget& budget);

/// The same for complex coefficients. The sequence is that of the polynomial times -1 if the
/// leading coefficient is real and negative, times its conjugate if it is not real.
RouthResult routh(const std::vector<ComplexRational>& coefficients);
RouthResult routh(const std::vector<ComplexRational>& coefficients, ExactBudget& budget);

}  // namespace whirl_twin
