// `twin routh`: counts of roots, exact for the numbers as typed.
#include <gtest/gtest.h>

#include <cmath>

#include "twin_program.h"

namespace whirl_twin {
namespace routh_command_test {

using Json = nlohmann::json;
using Words = std::vector<std::string>;

Json judged(Words coefficients) {
  coefficients.insert(coefficients.begin(), "routh");
  coefficients.push_back("--json");
  const Ending end = twin(coefficients);
  EXPECT_EQ(end.status, 0) << end.err;
  return end.json();
}

// s^2 + 2 zeta p s + p^2 with p = 10, zeta = 0.05.
TEST(Routh, MarginsOfADampedVibration) {
  const Json judgement = judged({"1", "1", "100"});
  EXPECT_EQ(judgement["verdict"], "asymptotically_stable");
  EXPECT_EQ(judgement["right"], 0);
  EXPECT_EQ(judgement["imaginary"], 0);
  EXPECT_EQ(judgement["left"], 2);
  EXPECT_EQ(judgement["degree"], 2);
  EXPECT_EQ(judgement["first_column"], Json({1.0, 1.0, 100.0}));
  EXPECT_DOUBLE_EQ(judgement["decay_rate"], 0.5);
  EXPECT_DOUBLE_EQ(judgement["damping_ratio"], 0.05);
  EXPECT_DOUBLE_EQ(judgement["log_decrement"], 2.0 * M_PI * 0.05 / std::sqrt(1.0 - 0.05 * 0.05));
  EXPECT_DOUBLE_EQ(judgement["roots"][0][0], -0.5);
  EXPECT_DOUBLE_EQ(judgement["roots"][0][1], std::sqrt(100.0 - 0.25));
}

struct Case {
  Words coefficients;
  std::string verdict;
  int right, imaginary, left;
};

class Verdicts : public testing::TestWithParam<Case> {};

TEST_P(Verdicts, CountRoots) {
  const Json judgement = judged(GetParam().coefficients);
  EXPECT_EQ(judgement["verdict"], GetParam().verdict);
  EXPECT_EQ(judgement["right"], GetParam().right);
  EXPECT_EQ(judgement["imaginary"], GetParam().imaginary);
  EXPECT_EQ(judgement["left"], GetParam().left);
  EXPECT_EQ(judgement["roots"].size(), judgement["degree"]);
}

INSTANTIATE_TEST_SUITE_P(
    Polynomials, Verdicts,
    testing::Values(Case{{"1", "0", "1"}, "marginal", 0, 2, 0},
                    Case{{"1", "0", "2", "0", "1"}, "repeated_imaginary", 0, 4, 0},
                    Case{{"1", "2", "0"}, "marginal", 0, 1, 1},
                    Case{{"1", "-3", "2"}, "unstable", 2, 0, 0},
                    Case{{"-1", "-3", "-2"}, "asymptotically_stable", 0, 0, 2},
                    Case{{"0", "0", "1", "3", "2"}, "asymptotically_stable", 0, 0, 2},
                    // (s + 0.1)(s^2 + 1) = s^3 + 0.1 s^2 + s + 0.1: as doubles 0.1 is not a tenth,
                    // and the roots would not be on the axis by their last bit.
                    Case{{"1", "0.1", "1", "0.1"}, "marginal", 0, 2, 1},
                    Case{{"1", "0.1", "1", "0.100000000000000000001"}, "unstable", 2, 0, 1},
                    // Beyond the range of double: 1e400 (s + 1)(s + 2).
                    Case{{"1e400", "3e400", "2e400"}, "asymptotically_stable", 0, 0, 2},
                    Case{{"1e-400", "3e-400", "2e-400"}, "asymptotically_stable", 0, 0, 2},
                    // Complex: (s + 1 - 2i)(s - 1 - i), and (s - i)(s + 1).
                    Case{{"1", "-3i", "-3+i"}, "unstable", 1, 0, 1},
                    Case{{"1", "1-i", "-j"}, "marginal", 0, 1, 1},
                    Case{{"5"}, "asymptotically_stable", 0, 0, 0}));

TEST(Routh, UndefinedMarginsAreNull) {
  const Json constant = judged({"5"});
  EXPECT_TRUE(constant["decay_rate"].is_null());
  EXPECT_TRUE(constant["damping_ratio"].is_null());
  EXPECT_TRUE(constant["log_decrement"].is_null());
  EXPECT_EQ(constant["roots"], Json::array());
  const Json overdamped = judged({"1", "3", "2"});
  EXPECT_EQ(overdamped["damping_ratio"], 1.0);
  EXPECT_TRUE(overdamped["log_decrement"].is_null());
}

// Rounded roots of (s^2 + 1)^2 lie 1e-10 to either side of the axis; the margins are zero.
TEST(Routh, MarginsAgreeWithTheExactVerdict) {
  const Json repeated = judged({"1", "0", "2", "0", "1"});
  EXPECT_EQ(repeated["decay_rate"], 0.0);
  EXPECT_EQ(repeated["damping_ratio"], 0.0);
  EXPECT_EQ(repeated["log_decrement"], 0.0);
  // A root at zero is a rigid body's, and no vibration.
  EXPECT_EQ(judged({"1", "2", "0"})["damping_ratio"], 1.0);
}

TEST(Routh, NumbersBeyondDoubleKeepTheirRoots) {
  const Json judgement = judged({"1e400", "3e400", "2e400"});
  EXPECT_NEAR(judgement["roots"][0][0], -1.0, 1e-15);  // rounding of 1/3 and 2/3
  EXPECT_NEAR(judgement["roots"][1][0], -2.0, 1e-15);
}

TEST(Routh, NegativeCoefficientsNeedNoDashes) {
  const Words plain{"routh", "1", "-2", "-.5", "-i", "--json"};
  const Words dashes{"routh", "--json", "--", "1", "-2", "-.5", "-i"};
  EXPECT_EQ(twin(plain).status, 0);
  EXPECT_EQ(twin(plain).out, twin(dashes).out);
}

TEST(Routh, EveryBadCoefficientIsNamed) {
  const Ending end = twin({"routh", "1", "nan", "2", "x+2i", "-inf"});
  EXPECT_EQ(end.status, 2);
  EXPECT_EQ(end.out, "");
  const Lines lines = linesOf(end.err);
  ASSERT_EQ(lines.size(), 3u) << end.err;
  EXPECT_EQ(lines[0].find("twin: coefficient 2 (of s^3): expected a finite "), 0u) << lines[0];
  EXPECT_NE(lines[0].find("\"nan\""), std::string::npos);
  EXPECT_EQ(lines[1].find("twin: coefficient 4 (of s^1): "), 0u) << lines[1];
  EXPECT_EQ(lines[2].find("twin: coefficient 5 (of s^0): "), 0u) << lines[2];
}

TEST(Routh, NoPolynomialIsLeftOfZeros) {
  const Ending end = twin({"routh", "0", "0"});
  EXPECT_EQ(end.status, 2);
  EXPECT_EQ(end.err, "twin: coefficients: at least one must not be zero, found none\n");
}

TEST(Routh, TakesFractions) {
  // 3 s^2 + s + 1, divided by 3: the sum of three thirds is one.
  EXPECT_EQ(judged({"1", "1/3", "1/3"})["first_column"], Json({1.0, 1.0 / 3.0, 1.0 / 3.0}));
  EXPECT_EQ(judged({"1", "1/3", "1", "1/3"})["verdict"], "marginal");
  EXPECT_EQ(twin({"routh", "1", "1/0"}).status, 2);
}

TEST(Routh, ShowsTheWholeTableAndWhatWasDoneToIt) {
  const Json table = judged({"1", "2", "8", "12", "20", "16", "16"})["table"];
  ASSERT_EQ(table.size(), 7u);
  EXPECT_EQ(table[0]["power"], 6);
  EXPECT_EQ(table[0]["entries"], Json({"1", "8", "20", "16"}));
  EXPECT_TRUE(table[2]["note"].is_null());
  const Ending end = twin({"routh", "1", "2", "8", "12", "20", "16", "16"});
  EXPECT_NE(end.out.find("s^3 all zero: the row above is a factor, 2 s^4 + 12 s^2 + 16"),
            std::string::npos)
      << end.out;
}

TEST(Routh, TellsForWhichParameterItIsStable) {
  const Words typed{"1", "2", "K", "3", "--parameter", "K"};
  const Json range = judged(typed);
  ASSERT_EQ(range["stable"].size(), 1u);
  EXPECT_EQ(range["stable"][0]["from"], 1.5);
  EXPECT_EQ(range["stable"][0]["from_exact"], "3/2");
  EXPECT_TRUE(range["stable"][0]["to"].is_null());
  EXPECT_EQ(range["table"][2]["entries"], Json({"(2 K - 3)/2"}));
  const Ending end = twin({"routh", "1", "2", "K", "3", "--parameter", "K"});
  EXPECT_EQ(linesOf(end.out).front(), "asymptotically stable for K > 3/2");
  EXPECT_NE(end.out.find("K = 3/2 = 1.5  a pair on the axis at 1.22474 rad/s"), std::string::npos)
      << end.out;
  // The option may be at any position, and coefficients begin with a minus.
  EXPECT_EQ(linesOf(twin({"routh", "--parameter", "K", "1", "2", "-K", "3"}).out).front(),
            "asymptotically stable for K < -3/2");
}

TEST(Routh, RefusesAParameterThatIsNone) {
  EXPECT_EQ(twin({"routh", "1", "2", "--parameter", "K"}).err,
            "twin: --parameter: no coefficient contains K\n");
  EXPECT_EQ(twin({"routh", "1", "2K", "--parameter", "2"}).status, 2);
  const Ending unknown = twin({"routh", "1", "2L", "--parameter", "K"});
  EXPECT_EQ(unknown.status, 2);
  EXPECT_EQ(unknown.err.find("twin: coefficient 2 (of s^0): expected a finite decimal number"), 0u)
      << unknown.err;
}

TEST(Routh, ReportForReaders) {
  const Ending end = twin({"routh", "1", "1", "100"});
  EXPECT_EQ(end.status, 0);
  EXPECT_EQ(linesOf(end.out).front(), "asymptotically stable (degree 2)");
  EXPECT_NE(end.out.find("decay rate      0.5 1/s"), std::string::npos) << end.out;
}

}  // namespace routh_command_test
}  // namespace whirl_twin
