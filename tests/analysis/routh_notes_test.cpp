// The stability criteria of the lecture notes, case by case, from Hurwitz minors and counts.
#include <gtest/gtest.h>

#include "analysis/routh.h"
#include "hurwitz_minors.h"
#include "reference_polynomials.h"

namespace whirl_twin {
namespace routh_notes_test {

using nlohmann::json;
using Polynomial = std::vector<Rational>;

std::vector<json> routhCases() {
  std::vector<json> chosen;
  for (const json& note : referenceCases("note_cases.json")) {
    if (note["id"].get<std::string>().rfind("routh.", 0) == 0) {
      chosen.push_back(note);
    }
  }
  return chosen;
}

/// The monic polynomial of the case: parameters A_(n-1) ... A_0.
Polynomial monicPolynomial(const json& parameters) {
  Polynomial polynomial{1};
  for (int power = static_cast<int>(parameters.size()) - 1; power >= 0; --power) {
    polynomial.emplace_back(parameters["A" + std::to_string(power)].get<double>());
  }
  return polynomial;
}

/// The whirl equation m z'' + (ce + ci) z' + (k - i ci w) z = 0 written in real coefficients.
Polynomial whirlPolynomial(const json& rotor) {
  const Rational m(rotor["m"].get<double>());
  const Rational ci(rotor["ci"].get<double>());
  const Rational c = (Rational(rotor["ce"].get<double>()) + ci) / m;
  const Rational stiffness = Rational(rotor["k"].get<double>()) / m;
  const Rational circulation = ci * Rational(rotor["w"].get<double>()) / m;
  Polynomial polynomial = product<Rational>({1, c, stiffness}, {1, c, stiffness});
  polynomial.back() += circulation * circulation;
  return polynomial;
}

/// The examples of the notes from their roots: -1, -1 +- i and -1 +- i, -2 +- 2i.
Polynomial examplePolynomial(const std::string& example) {
  return example == "cubic" ? product<Rational>({1, 1}, {1, 2, 2})
                            : product<Rational>({1, 2, 2}, {1, 4, 8});
}

Rational valueOf(const std::string& example, const std::string& quantity, const json& parameters) {
  if (example == "internal") {
    return hurwitzMinors(whirlPolynomial(parameters))[2];
  }
  if (quantity.front() == 'A') {
    const Polynomial polynomial = examplePolynomial(example);
    return polynomial[polynomial.size() - 1 - std::stoi(quantity.substr(1))];
  }
  const Polynomial polynomial = monicPolynomial(parameters);
  if (quantity.front() == 'D') {
    return hurwitzMinors(polynomial)[std::stoi(quantity.substr(1)) - 1];
  }
  if (quantity == "rhp") {
    return routh(polynomial).right;
  }
  if (quantity == "margin") {
    return hurwitzMinors(polynomial)[2];
  }
  if (quantity == "misprint") {
    const Rational a3 = polynomial[1];
    const Rational a2 = polynomial[2];
    const Rational a1 = polynomial[3];
    return a1 * a2 * a3 - a1 * a1 - a2 * a2 * a2 * polynomial[4];
  }
  throw std::runtime_error("unknown quantity " + quantity);
}

class NoteCase : public ::testing::TestWithParam<json> {};

TEST_P(NoteCase, HasTheKnownValue) {
  const json& note = GetParam();
  const std::string id = note["id"];
  const std::size_t first = id.find('.');
  const std::size_t second = id.find('.', first + 1);
  const Rational value =
      valueOf(id.substr(first + 1, second - first - 1), id.substr(second + 1), note["params"]);
  EXPECT_NEAR(toDouble(value), note["expected"].get<double>(), note["tolerance"].get<double>())
      << note["what"];
}

INSTANTIATE_TEST_SUITE_P(Routh, NoteCase, ::testing::ValuesIn(routhCases()),
                         [](const auto& test) { return testName(test.param["id"]); });

TEST(NoteCriteria, TheMisprintedQuarticWouldCallAStableSystemUnstable) {
  const Polynomial polynomial = examplePolynomial("quartic");
  EXPECT_EQ(routh(polynomial).verdict, Verdict::kAsymptoticallyStable);
  EXPECT_GT(hurwitzMinors(polynomial)[2], 0);
}

TEST(NoteCriteria, ACubicIsStableIfA1TimesA2ExceedsA0) {
  // s^3 + 3s^2 + 4s + A0, at, just below and just above A0 = 12.
  EXPECT_EQ(routh(Polynomial{1, 3, 4, 12}).verdict, Verdict::kMarginal);
  EXPECT_EQ(routh(Polynomial{1, 3, 4, parseRational("11.999999999999999999")}).verdict,
            Verdict::kAsymptoticallyStable);
  EXPECT_EQ(routh(Polynomial{1, 3, 4, parseRational("12.000000000000000001")}).verdict,
            Verdict::kUnstable);
}

TEST(NoteCriteria, TheSexticOnTheBoundaryIsMarginal) {
  EXPECT_EQ(routh(std::vector<double>{1, 2, 15.5, 23.5, 63.8125, 49.5, 47.8125}).verdict,
            Verdict::kMarginal);
}

}  // namespace routh_notes_test
}  // namespace whirl_twin
