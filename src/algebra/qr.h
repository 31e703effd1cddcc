// Eigen's QR factorizations, those of dense matrices of any size compiled once, in qr.cpp:
// compiling them takes longer than all that most files that use them have to say.
#pragma once

#include <Eigen/QR>

// NOLINTBEGIN(bugprone-macro-parentheses): a word of the language
#define WHIRL_TWIN_QR(storage)                                   \
  storage template class Eigen::HouseholderQR<Eigen::MatrixXd>;  \
  storage template class Eigen::HouseholderQR<Eigen::MatrixXcd>; \
  storage template class Eigen::ColPivHouseholderQR<Eigen::MatrixXd>;
// NOLINTEND(bugprone-macro-parentheses)
WHIRL_TWIN_QR(extern)
