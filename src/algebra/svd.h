// Eigen's singular value decompositions, those of dense matrices of any size compiled once, in
// svd.cpp: compiling them takes longer than all that most files that use them have to say.
#pragma once

#include <Eigen/SVD>

// NOLINTBEGIN(bugprone-macro-parentheses): a word of the language
#define WHIRL_TWIN_SVD(storage)                             \
  storage template class Eigen::JacobiSVD<Eigen::MatrixXd>; \
  storage template class Eigen::JacobiSVD<Eigen::MatrixXcd>;
// NOLINTEND(bugprone-macro-parentheses)
WHIRL_TWIN_SVD(extern)
