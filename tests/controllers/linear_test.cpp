// Linear controllers by matrices and by a transfer function: their samples, and their errors.
#include <gtest/gtest.h>

#include "example_controllers.h"

namespace whirl_twin {
namespace linear_test {

using Eigen::MatrixXd;

std::vector<double> outputsOf(Controller& controller, const std::vector<double>& y) {
  std::vector<double> all;
  for (const double value : y) {
    double u = 0.0;
    controller.update(sampleOf(&value), &u);
    all.push_back(u);
  }
  return all;
}

// u(k) = u(k - 1) + 2 y(k) - y(k - 1).
TEST(Linear, IsItsDifferenceEquation) {
  const std::vector<double> expected{2.0, 1.0, 1.0, -5.0};
  const auto fraction =
      made("linear", {}, matrices({{"numerator", row({2, -1})}, {"denominator", row({1, -1})}}),
           planOf(10.0, 1));
  EXPECT_EQ(outputsOf(*fraction, {1.0, 0.0, 0.0, -3.0}), expected);
  const auto states = made(
      "linear", {}, matrices({{"a", row({1})}, {"b", row({1})}, {"c", row({1})}, {"d", row({2})}}),
      planOf(10.0, 1));
  EXPECT_EQ(outputsOf(*states, {1.0, 0.0, 0.0, -3.0}), expected);
}

TEST(Linear, GoesBySetpoints) {
  const auto law = made("linear", {}, matrices({{"d", row({-2, 1})}, {"setpoint", row({3, 1})}}),
                        planOf(10.0, 2, 1));
  const double y[] = {4.0, 6.0};
  double u = 0.0;
  law->update(sampleOf(y), &u);
  EXPECT_EQ(u, 3.0);
}

TEST(Linear, RefusesWhatDoesNotFitTogether) {
  const ControllerPlan plan = planOf(10.0, 3, 2);
  const MatrixXd two = MatrixXd::Identity(2, 2);
  const MatrixXd two_by_three = MatrixXd::Ones(2, 3);
  const auto refused = [&](std::map<std::string, MatrixXd> given) {
    const auto [name, text] = inputError("linear", {}, matrices(std::move(given)), plan);
    return name + ": " + text;
  };
  EXPECT_EQ(
      refused({}),
      "d: missing; a linear control law needs d, or a, b, c and d, or numerator and denominator");
  EXPECT_EQ(refused({{"d", two}}),
            "d: must be 2 x 3, a row per output, a column per measured signal, found 2 x 2");
  EXPECT_EQ(refused({{"a", two_by_three}, {"b", two_by_three}, {"c", two}}),
            "a: must be 2 x 2, a row and a column per state, found 2 x 3");
  EXPECT_EQ(refused({{"a", two}, {"b", two}, {"c", two}}),
            "b: must be 2 x 3, a row per state, a column per measured signal, found 2 x 2");
  EXPECT_EQ(refused({{"a", two}, {"b", two_by_three}, {"c", two_by_three}}),
            "c: must be 2 x 2, a row per output, a column per state, found 2 x 3");
  EXPECT_EQ(refused({{"a", two}, {"c", two}}), "b: missing; a, b and c must be given together");
  EXPECT_EQ(refused({{"c", two}, {"d", two_by_three}}),
            "a: missing; a, b and c must be given together, found c");
  EXPECT_EQ(refused({{"d", two_by_three}, {"setpoint", row({1, 2})}}),
            "setpoint: must be 1 x 3, a number for each measured signal, found 1 x 2");
  EXPECT_EQ(refused({{"numerator", row({1})}}),
            "denominator: missing; numerator and denominator must be given together");
  EXPECT_EQ(refused({{"numerator", row({1})}, {"denominator", row({0, 1})}}),
            "denominator: the first number must not be 0, found 0");
  EXPECT_EQ(
      refused({{"numerator", row({1, 2, 3})}, {"denominator", row({1, 1})}}),
      "numerator: must have at most 2 coefficients, as the denominator has (causality), found 3");
  EXPECT_EQ(refused({{"numerator", two}, {"denominator", row({1, 1})}}),
            "numerator: must be 1 x 2, coefficients of falling powers of z, found 2 x 2");
  EXPECT_EQ(refused({{"numerator", row({1})}, {"denominator", row({1})}, {"d", two_by_three}}),
            "d: must not be given with numerator and denominator");
  EXPECT_EQ(refused({{"numerator", row({1})}, {"denominator", row({1})}}),
            "numerator: acts axis by axis: must have as many measured signals as outputs, found 3 "
            "measured, 2 acted on");
}

}  // namespace linear_test
}  // namespace whirl_twin
