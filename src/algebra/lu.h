// Eigen's LU factorizations, those of dense matrices of any size compiled once, in lu.cpp:
// compiling them takes longer than all that most files that use them have to say.
#pragma once

#include <Eigen/LU>

// NOLINTBEGIN(bugprone-macro-parentheses): a word of the language
#define WHIRL_TWIN_LU(storage)                                  \
  storage template class Eigen::PartialPivLU<Eigen::MatrixXd>;  \
  storage template class Eigen::PartialPivLU<Eigen::MatrixXcd>; \
  storage template class Eigen::FullPivLU<Eigen::MatrixXd>;
// NOLINTEND(bugprone-macro-parentheses)
WHIRL_TWIN_LU(extern)
