// Eigen's eigenvalue solvers, those of dense matrices of any size compiled once, in
// eigenvalues.cpp: compiling them takes longer than all that most files that use them have to say.
#pragma once

#include <Eigen/Eigenvalues>

// NOLINTBEGIN(bugprone-macro-parentheses): a word of the language
#define WHIRL_TWIN_EIGENVALUES(storage)                                                           \
  storage template Eigen::EigenSolver<Eigen::MatrixXd>&                                           \
  Eigen::EigenSolver<Eigen::MatrixXd>::compute(const Eigen::EigenBase<Eigen::MatrixXd>&, bool);   \
  storage template Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>&                                \
  Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>::compute(                                        \
      const Eigen::EigenBase<Eigen::MatrixXd>&, int);                                             \
  storage template Eigen::SelfAdjointEigenSolver<Eigen::MatrixXcd>&                               \
  Eigen::SelfAdjointEigenSolver<Eigen::MatrixXcd>::compute(                                       \
      const Eigen::EigenBase<Eigen::MatrixXcd>&, int);                                            \
  storage template Eigen::ComplexEigenSolver<Eigen::MatrixXcd>&                                   \
  Eigen::ComplexEigenSolver<Eigen::MatrixXcd>::compute(const Eigen::EigenBase<Eigen::MatrixXcd>&, \
                                                       bool);
// NOLINTEND(bugprone-macro-parentheses)
WHIRL_TWIN_EIGENVALUES(extern)
