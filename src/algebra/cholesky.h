// Eigen's Cholesky factorizations, those of dense matrices of any size compiled once, in
// cholesky.cpp: compiling them takes longer than all that most files that use them have to say.
#pragma once

#include <Eigen/Cholesky>

// NOLINTBEGIN(bugprone-macro-parentheses): a word of the language
#define WHIRL_TWIN_CHOLESKY(storage)                                                    \
  storage template Eigen::LLT<Eigen::MatrixXd>& Eigen::LLT<Eigen::MatrixXd>::compute(   \
      const Eigen::EigenBase<Eigen::MatrixXd>&);                                        \
  storage template Eigen::LDLT<Eigen::MatrixXd>& Eigen::LDLT<Eigen::MatrixXd>::compute( \
      const Eigen::EigenBase<Eigen::MatrixXd>&);
// NOLINTEND(bugprone-macro-parentheses)
WHIRL_TWIN_CHOLESKY(extern)
