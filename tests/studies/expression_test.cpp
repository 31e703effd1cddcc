#include "studies/expression.h"

#include <gtest/gtest.h>

#include <cmath>

#include "messages/input_error.h"

namespace whirl_twin {
namespace expression_test {

double value(const std::string& text, const std::vector<double>& leaves = {}) {
  return Expression(text).value(leaves);
}

TEST(Expression, FollowsTheRulesOfArithmetic) {
  EXPECT_EQ(value("1 + 2 * 3"), 7.0);
  EXPECT_EQ(value("(1 + 2) * 3"), 9.0);
  EXPECT_EQ(value("8 - 4 - 2"), 2.0);
  EXPECT_EQ(value("8 / 4 / 2"), 1.0);
  EXPECT_EQ(value("2 ^ 3 ^ 2"), 512.0);
  EXPECT_EQ(value("-2 ^ 2"), -4.0);
  EXPECT_EQ(value("2 * -3"), -6.0);
  EXPECT_EQ(value("1e3 - 1.5e-1"), 999.85);
  EXPECT_EQ(value("sqrt(abs(-16)) + log(1)"), 4.0);
}

TEST(Expression, NamesWhatItStandsOn) {
  const Expression e("max(rotor.whirl.radius) / 2.0e-4 - rotor.critical_speeds[1].speed");
  ASSERT_EQ(e.leaves().size(), 2U);
  EXPECT_EQ(e.leaves()[0].reduction, "max");
  EXPECT_EQ(e.leaves()[0].path, "rotor.whirl.radius");
  EXPECT_EQ(e.leaves()[1].reduction, "");
  EXPECT_EQ(e.leaves()[1].path, "rotor.critical_speeds[1].speed");
  EXPECT_DOUBLE_EQ(e.value({4.0e-4, 1.5}), 0.5);
}

TEST(Expression, IsRefusedWithThePlace) {
  const auto inputError = [](const std::string& text) -> std::string {
    try {
      Expression e(text);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(inputError("1 +"), "must have a number, a name or '(' at character 4, found the end");
  EXPECT_EQ(inputError("(1"), "must have ')' at character 3, found the end");
  EXPECT_EQ(inputError("1 2"), "must have an operator or the end at character 3, found '2'");
  EXPECT_NE(inputError("mx(rotor.x)").find("did you mean 'max'?"), std::string::npos);
  EXPECT_NE(inputError("max(rotor.x, 2)").find("one argument"), std::string::npos);
  EXPECT_NE(inputError("settling(rotor.x, 2)").find("> 0 and < 1"), std::string::npos);
  EXPECT_NE(inputError(std::string(500, '(')).find("nested"), std::string::npos);
  EXPECT_NE(inputError(std::string(5000, '1')), "");
  EXPECT_NE(inputError(""), "");
  EXPECT_NE(inputError("1e999"), "");
}

double reduced(const std::string& name, double argument = 0.02) {
  Reduction reduction(name, argument);
  // e^(-t) cos(2 pi t), the start of which is its largest value
  for (int k = 0; k <= 1000; ++k) {
    const double t = 0.01 * k;
    reduction.take(5.0 + t, std::exp(-t) * std::cos(2.0 * 3.14159265358979323846 * t));
  }
  return reduction.result();
}

TEST(Reduction, OfADecayingVibration) {
  EXPECT_EQ(reduced("max"), 1.0);
  EXPECT_EQ(reduced("initial"), 1.0);
  EXPECT_EQ(reduced("peak"), 1.0);
  EXPECT_EQ(reduced("time_of_max"), 5.0);
  EXPECT_NEAR(reduced("final"), std::exp(-10.0), 1.0e-15);
  EXPECT_NEAR(reduced("min"), -std::exp(-0.5) * 1.012, 0.003);
  EXPECT_DOUBLE_EQ(reduced("range"), 1.0 - reduced("min"));
  EXPECT_NEAR(std::pow(reduced("rms"), 2),
              std::pow(reduced("mean"), 2) + std::pow(reduced("standard_deviation"), 2), 1.0e-15);
  // e^(-t) = 0.02 at t = 3.91: between the extremes of 3.5 and 4 the last to leave the band is 3.5
  EXPECT_NEAR(reduced("settling"), 3.615, 0.02);
  EXPECT_LT(reduced("settling", 0.2), reduced("settling", 0.02));
}

TEST(Reduction, WhatKeepsSwingingDoesNotSettle) {
  Reduction swinging("settling", 0.02);
  Reduction still("settling", 0.02);
  for (int k = 0; k <= 100; ++k) {
    swinging.take(k, k % 2 == 0 ? 1.0 : -1.0);
    still.take(k, 3.0);
  }
  EXPECT_TRUE(std::isnan(swinging.result()));
  EXPECT_EQ(still.result(), 0.0);
}

}  // namespace expression_test
}  // namespace whirl_twin
