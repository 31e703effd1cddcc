// Routh's table in textbook form, and the parameter ranges in which a polynomial is stable.
#include "analysis/routh_table.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "analysis/routh.h"
#include "analysis/stability_range.h"

namespace whirl_twin {
namespace routh_table_test {

std::vector<SymbolicPolynomial> polynomial(const std::vector<std::string>& typed,
                                           const std::string& symbol = "") {
  std::vector<SymbolicPolynomial> coefficients;
  for (const std::string& one : typed) {
    coefficients.push_back(parseSymbolic(one, symbol));
  }
  return coefficients;
}

std::vector<std::string> entries(const RouthTableRow& row, const std::string& symbol = "") {
  std::vector<std::string> all;
  for (const SymbolicQuotient& entry : row.entry) {
    all.push_back(text(entry, symbol));
  }
  return all;
}

using Words = std::vector<std::string>;

TEST(RouthTable, IsThatOfTheTextbook) {
  const RouthTable table = routhTable(polynomial({"1", "2", "3", "4", "5"}), "");
  ASSERT_EQ(table.rows.size(), 5u);
  EXPECT_EQ(entries(table.rows[0]), (Words{"1", "3", "5"}));
  EXPECT_EQ(entries(table.rows[1]), (Words{"2", "4"}));
  EXPECT_EQ(entries(table.rows[2]), (Words{"1", "5"}));
  EXPECT_EQ(entries(table.rows[3]), (Words{"-6"}));
  EXPECT_EQ(entries(table.rows[4]), (Words{"5"}));
  for (const RouthTableRow& row : table.rows) {
    EXPECT_EQ(row.note, "");
  }
}

TEST(RouthTable, KeepsFractions) {
  const RouthTable table = routhTable(polynomial({"1", "1/3", "0.1", "2"}), "");
  EXPECT_EQ(entries(table.rows[1]), (Words{"1/3", "2"}));
  EXPECT_EQ(entries(table.rows[2]), (Words{"-59/10"}));
}

// s^6 + 2 s^5 + 8 s^4 + 12 s^3 + 20 s^2 + 16 s + 16 (Ogata): its row s^3 is zero, the auxiliary
// polynomial 2 s^4 + 12 s^2 + 16 has the roots +-sqrt(2) j and +-2 j.
TEST(RouthTable, ExplainsARowOfZeros) {
  const RouthTable table = routhTable(polynomial({"1", "2", "8", "12", "20", "16", "16"}), "");
  EXPECT_NE(table.rows[3].note.find("2 s^4 + 12 s^2 + 16"), std::string::npos)
      << table.rows[3].note;
  EXPECT_NE(table.rows[3].note.find("its derivative 8 s^3 + 24 s"), std::string::npos);
  EXPECT_EQ(entries(table.rows[3]), (Words{"8", "24"}));
}

TEST(RouthTable, ExplainsAZeroInFront) {
  const RouthTable table = routhTable(polynomial({"1", "1", "2", "2", "3"}), "");
  EXPECT_NE(table.rows[2].note.find("begins with a zero"), std::string::npos) << table.rows[2].note;
}

TEST(RouthTable, HasTheSymbolInItsEntries) {
  const RouthTable table = routhTable(polynomial({"1", "2", "K", "3"}, "K"), "K");
  EXPECT_EQ(entries(table.rows[0], "K"), (Words{"1", "K"}));
  EXPECT_EQ(entries(table.rows[2], "K"), (Words{"(2 K - 3)/2"}));
  EXPECT_EQ(entries(table.rows[3], "K"), (Words{"3"}));
}

// The first column is that of the stability test; also where rows are zero or begin with zeros.
TEST(RouthTable, HasTheFirstColumnOfTheTest) {
  std::mt19937 random(1);
  std::uniform_int_distribution<int> digit(-2, 2);
  for (int i = 0; i < 600; ++i) {
    std::vector<Rational> numbers(2 + i % 7);
    for (Rational& a : numbers) {
      a = digit(random);
    }
    numbers.front() = numbers.front() == 0 ? 1 : numbers.front();
    const std::vector<double> column = routh(numbers).first_column;
    const RouthTable table =
        routhTable(std::vector<SymbolicPolynomial>(numbers.begin(), numbers.end()), "");
    ASSERT_EQ(table.rows.size(), column.size());
    for (std::size_t k = 0; k < column.size(); ++k) {
      EXPECT_DOUBLE_EQ(toDouble(table.rows[k].entry.front().numerator.at(0) /
                                table.rows[k].entry.front().denominator.at(0)),
                       column[k])
          << "polynomial " << i << ", row " << k;
    }
  }
}

TEST(SymbolicPolynomial, IsReadAsItIsWritten) {
  for (const auto& [typed, printed] :
       std::vector<std::pair<std::string, std::string>>{{"K", "K"},
                                                        {"-K", "-K"},
                                                        {"2K", "2 K"},
                                                        {"2*K + 1", "2 K + 1"},
                                                        {"(K+1)/3", "1/3 K + 1/3"},
                                                        {"(K - 1)(K + 1)", "K^2 - 1"},
                                                        {"0.5 K^2 - 1/3", "1/2 K^2 - 1/3"},
                                                        {"2e-1K", "1/5 K"},
                                                        {"K - K", "0"}}) {
    EXPECT_EQ(text(parseSymbolic(typed, "K"), "K"), printed) << typed;
  }
  for (const char* wrong :
       {"", "L", "1/K", "1/0", "K^", "K^99", "2 3", "(K", "K)", "1..2", "nan"}) {
    EXPECT_THROW(parseSymbolic(wrong, "K"), InputError) << wrong;
  }
}

StabilityRange rangeOf(const Words& typed) {
  ExactBudget budget(1.0e9);
  return stabilityRange(polynomial(typed, "K"), budget);
}

constexpr double kNone = std::numeric_limits<double>::infinity();

/// The pieces as pairs of numbers, ends included or not as a string of brackets.
std::vector<std::tuple<double, double, std::string>> piecesOf(const StabilityRange& range) {
  std::vector<std::tuple<double, double, std::string>> all;
  for (const StablePiece& piece : stablePieces(range)) {
    all.emplace_back(
        piece.from ? range.bounds[*piece.from].value() : -kNone,
        piece.to ? range.bounds[*piece.to].value() : kNone,
        std::string(piece.from_included ? "[" : "(") + (piece.to_included ? "]" : ")"));
  }
  return all;
}

using Pieces = std::vector<std::tuple<double, double, std::string>>;

// s (s + 1)(s + 2) + K: 0 < K < 6, at 6 a pair at sqrt(2) rad/s (the root locus of every textbook).
TEST(StabilityRange, OfTheTextbook) {
  const StabilityRange range = rangeOf({"1", "3", "2", "K"});
  EXPECT_EQ(piecesOf(range), (Pieces{{0.0, 6.0, "()"}}));
  ASSERT_EQ(range.bounds.size(), 2u);
  EXPECT_TRUE(range.bounds[0].root_at_zero);
  EXPECT_FALSE(range.bounds[0].pair_on_axis);
  EXPECT_TRUE(range.bounds[1].pair_on_axis);
  EXPECT_EQ(range.bounds[1].closed_form, "6");
  EXPECT_NEAR(*range.bounds[1].frequency, std::sqrt(2.0), 1.0e-15);
  EXPECT_EQ(range.bounds[1].there->imaginary, 2);
  EXPECT_EQ(range.intervals[2].routh.right, 2);
}

TEST(StabilityRange, HasExactBounds) {
  EXPECT_EQ(rangeOf({"1", "2", "K", "3"}).bounds[0].closed_form, "3/2");
  // s^3 + K s^2 + (K + 1) s + 1: K (K + 1) > 1, from the golden section on.
  const StabilityRange golden = rangeOf({"1", "K", "K+1", "1"});
  ASSERT_EQ(stablePieces(golden).size(), 1u);
  const StabilityBound& bound = golden.bounds[*stablePieces(golden)[0].from];
  EXPECT_EQ(bound.closed_form, "-1/2 + sqrt(5)/2");
  EXPECT_EQ(bound.value(), (std::sqrt(5.0) - 1.0) / 2.0);
  EXPECT_EQ(text(bound.of, "K"), "K^2 + K - 1");
  // K^3 - 2 > 0 has no such form.
  const StabilityRange cube = rangeOf({"1", "1", "K^3 - 2"});
  EXPECT_EQ(cube.bounds[0].closed_form, "");
  EXPECT_DOUBLE_EQ(cube.bounds[0].value(),
                   std::cbrt(2.0));  // of the C library, which need not round correctly
  EXPECT_EQ(text(cube.bounds[0].of, "K"), "K^3 - 2");
}

TEST(StabilityRange, MayBeOfSeveralPieces) {
  // s + (K - 1)(K - 2)(K - 3)
  EXPECT_EQ(piecesOf(rangeOf({"1", "(K - 1)(K - 2)(K - 3)"})),
            (Pieces{{1.0, 2.0, "()"}, {3.0, kNone, "()"}}));
  // Stable but where the constant touches zero.
  EXPECT_EQ(piecesOf(rangeOf({"1", "2", "K^2"})),
            (Pieces{{-kNone, 0.0, "()"}, {0.0, kNone, "()"}}));
}

// K s^2 + s + 2: at K = 0 one root has left through infinity, s + 2 is stable.
TEST(StabilityRange, HoldsWhereTheDegreeFalls) {
  EXPECT_EQ(piecesOf(rangeOf({"K", "1", "2"})), (Pieces{{0.0, kNone, "[)"}}));
  EXPECT_EQ(piecesOf(rangeOf({"K^2", "1", "2"})), (Pieces{{-kNone, kNone, "()"}}));
  // (K^2 - 2) s^2 + s + 2: outside of +-sqrt(2), ends included.
  const double root = std::sqrt(2.0);
  EXPECT_EQ(piecesOf(rangeOf({"K^2 - 2", "1", "2"})),
            (Pieces{{-kNone, -root, "(]"}, {root, kNone, "[)"}}));
}

TEST(StabilityRange, IsNothingWhereAPairStaysOnTheAxis) {
  const StabilityRange range = rangeOf({"1", "0", "K"});
  EXPECT_TRUE(range.never);
  EXPECT_EQ(piecesOf(range), Pieces{});
  EXPECT_EQ(range.intervals.back().routh.imaginary, 2);
}

// Between the bounds the counts are those of any K there: checked on a grid, by the exact test.
TEST(StabilityRange, CountsAreThoseOfEveryValue) {
  std::mt19937 random(2);
  std::uniform_int_distribution<int> digit(-3, 3);
  for (int i = 0; i < 80; ++i) {
    std::vector<SymbolicPolynomial> coefficients(2 + i % 4);
    for (SymbolicPolynomial& a : coefficients) {
      a = SymbolicPolynomial(std::vector<Rational>{digit(random), digit(random)});
    }
    if (coefficients.front().zero()) {
      coefficients.front() = Rational(1);
    }
    ExactBudget budget(1.0e9);
    const StabilityRange range = stabilityRange(coefficients, budget);
    for (int k = -40; k <= 40; ++k) {
      const Rational value = Rational(k, 7) + Rational(1, 1000);  // on no bound of such numbers
      std::size_t place = 0;
      while (place < range.bounds.size() && range.bounds[place].above < value) {
        ++place;
      }
      if (place < range.bounds.size() && range.bounds[place].below < value &&
          !range.bounds[place].exact) {
        continue;
      }
      std::vector<Rational> there;
      for (const SymbolicPolynomial& a : coefficients) {
        there.push_back(a.at(value));
      }
      const RouthResult judged = routh(there);
      EXPECT_EQ(range.intervals[place].routh.right, judged.right) << i << " at " << value;
      EXPECT_EQ(range.intervals[place].routh.verdict, judged.verdict) << i << " at " << value;
    }
  }
}

TEST(StabilityRange, RefusesWhatIsNoPolynomialInS) {
  EXPECT_THROW(rangeOf({"K"}), InputError);
  EXPECT_THROW(rangeOf({"0", "0"}), InputError);
  EXPECT_THROW(rangeOf(Words(18, "K")), InputError);
}

}  // namespace routh_table_test
}  // namespace whirl_twin
