// Every reference number of the lecture notes that belongs to a model of this program is
// reproduced.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "note_case.h"

namespace whirl_twin {
namespace note_cases_test {

using Answers = std::vector<double> (*)(const NoteCase&);

// Systems of the notes that a model of this program covers, with the number of their cases.
struct Modelled {
  std::size_t cases;
  Answers answers;
};
const std::map<std::string, Modelled> kModelled{
    {"spinning_pendulum", {36, spinningPendulumAnswers}},
    {"double_pendulum", {51, doublePendulumAnswers}},
    {"double_pendulum_rel", {22, relativeDoublePendulumAnswers}},
    {"rigid_beam", {16, rigidBeamAnswers}},
    {"rigid_beam_nl", {8, rigidBeamAnswers}},
    {"two_bar", {15, twoBarAnswers}},
    {"rolling_disc", {11, rollingDiscAnswers}},
    {"eccentric_disc", {23, eccentricDiscAnswers}},
    {"rod_slider", {16, rodSliderAnswers}},
    {"cart_pendulum", {10, cartAnswers}},
    {"cart_pendulum_force", {3, cartAnswers}},
    {"cart_pendulum_support", {2, cartAnswers}},
    {"inverted_spring", {32, invertedSpringAnswers}},
    {"rotating_pendulum", {52, rotatingPendulumAnswers}},
    {"friction_oscillator", {30, frictionAnswers}},
    {"flywheel2", {10, symmetricFlywheelAnswers}},
    {"flywheel3", {5, flywheelAnswers}},
    {"governor", {3, governorAnswers}},
    {"lever3", {40, leverAnswers}},  // methods of src/analysis on its matrices
    {"submarine", {6, submarineAnswers}},
    {"cantilever_amm", {28, cantileverAnswers}},
    {"jeffcott", {23, rotorAnswers}},        // synchronous whirl: unbalance response of the rotor
    {"jeffcott_xy", {7, rotorAnswers}},      // the rotor's own coordinates
    {"jeffcott_polar", {13, rotorAnswers}},  // the same motion seen in polar coordinates
    {"jeffcott_rot", {12, rotorAnswers}},    // the same motion seen from the turning shaft
    {"jeffcott_spin", {25, freeRotorAnswers}},
    {"jeffcott_fluid", {5, fluidWhirlAnswers}},  // this and what follows by their matrices
    {"jeffcott_hysteretic", {2, hystereticWhirlAnswers}},
    {"gyro_disc", {6, gyroscopicTiltAnswers}},
};

// Systems that no model of this program covers, and why.
const std::map<std::string, std::string> kNotModelled{
    {"routh", "polynomials: tested with the Routh criterion"},
};

std::vector<NoteCase> modelledCases() {
  std::vector<NoteCase> cases = noteCases();
  cases.erase(std::remove_if(cases.begin(), cases.end(),
                             [](const NoteCase& c) { return kModelled.count(c.system) == 0; }),
              cases.end());
  return cases;
}

TEST(NoteCases, EveryCaseIsRunOrItsSystemIsNamedAsNotModelled) {
  std::map<std::string, std::size_t> count;
  for (const NoteCase& c : noteCases()) {
    ++count[c.system];
    if (kModelled.count(c.system) != 0) {
      EXPECT_FALSE(kModelled.at(c.system).answers(c).empty()) << c.id << " is not run";
    } else {
      EXPECT_EQ(kNotModelled.count(c.system), 1u) << c.id << " is of an unknown system";
    }
  }
  for (const auto& [system, modelled] : kModelled) {
    EXPECT_EQ(count[system], modelled.cases) << system;
  }
}

class NoteCaseOf : public testing::TestWithParam<NoteCase> {};

TEST_P(NoteCaseOf, IsReproduced) {
  const NoteCase& c = GetParam();
  // Accelerations are evaluated, not integrated: a dozen roundings. All else within the tolerance
  // that comes with the case.
  const double tolerance = c.startsWith("acc.") ? 1e-12 * std::abs(c.expected) : c.tolerance;
  for (const double answer : kModelled.at(c.system).answers(c)) {
    EXPECT_NEAR(answer, c.expected, tolerance);
  }
}

INSTANTIATE_TEST_SUITE_P(Notes, NoteCaseOf, testing::ValuesIn(modelledCases()),
                         [](const auto& test) { return testName(test.param); });

}  // namespace note_cases_test
}  // namespace whirl_twin
