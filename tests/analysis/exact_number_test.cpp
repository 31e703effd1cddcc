#include "analysis/exact_number.h"

#include <gtest/gtest.h>

#include <cfloat>

#include "messages/input_error.h"

namespace whirl_twin {
namespace exact_number_test {

TEST(ParseRational, IsExactWhereADoubleIsNot) {
  EXPECT_EQ(parseRational("0.1"), Rational(1, 10));
  EXPECT_EQ(parseRational("-2.5E+3"), Rational(-2500));
  EXPECT_EQ(parseRational("+007.50"), Rational(15, 2));
  EXPECT_EQ(parseRational(".5"), Rational(1, 2));
  EXPECT_EQ(parseRational("3."), Rational(3));
  EXPECT_EQ(parseRational("-0"), Rational(0));
  EXPECT_EQ(parseRational("1e-200") * parseRational("1e200"), Rational(1));
  EXPECT_EQ(parseRational("1e5000") * parseRational("1e-5000"), Rational(1));
}

TEST(ParseRational, RefusesWhatIsNotAFiniteDecimalNumber) {
  for (const char* text :
       {"", "+", ".", "e5", "1e", "1e+", "nan", "inf", "-inf", "0x10", "1,5", " 1", "1 ", "1e5001",
        "1e-5001", "1e99999999999999999999", "1e1.5", "--1", "2i"}) {
    EXPECT_THROW(parseRational(text), InputError) << '"' << text << '"';
  }
}

TEST(ParseRational, SaysWhatItExpectedAndFound) {
  try {
    parseRational("12rpm");
    FAIL() << "accepted 12rpm";
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(), "expected a finite decimal number, found \"12rpm\"");
  }
}

void expectComplex(const char* text, const Rational& re, const Rational& im) {
  const ComplexRational value = parseComplex(text);
  EXPECT_EQ(value.re, re) << text;
  EXPECT_EQ(value.im, im) << text;
}

TEST(ParseComplex, ReadsRealImaginaryAndBoth) {
  expectComplex("3", 3, 0);
  expectComplex("3+2i", 3, 2);
  expectComplex("-1e-3-2.5i", Rational(-1, 1000), Rational(-5, 2));
  expectComplex("2i", 0, 2);
  expectComplex("i", 0, 1);
  expectComplex("-i", 0, -1);
  expectComplex("4-j", 4, -1);
  expectComplex("1e-3+1e2j", Rational(1, 1000), 100);
  expectComplex("1e-3j", 0, Rational(1, 1000));
}

TEST(ParseComplex, RefusesTheRest) {
  for (const char* text : {"", "3+", "3+2", "3+2k", "3+2ii", "1i+2i", "inf+2i", "nani", "3 + 2i",
                           "1e-i", "3+2i5", "++i"}) {
    EXPECT_THROW(parseComplex(text), InputError) << '"' << text << '"';
  }
}

TEST(ToDouble, IsTheNearestDouble) {
  EXPECT_EQ(toDouble(Rational(1, 3)), 1.0 / 3.0);
  EXPECT_EQ(toDouble(Rational(-5, 2)), -2.5);
  EXPECT_EQ(toDouble(Rational(0)), 0.0);
  EXPECT_EQ(toDouble(parseRational("0.1")), 0.1);
  EXPECT_EQ(toDouble(parseRational("1e-200")), 1e-200);
  EXPECT_EQ(toDouble(Rational(DBL_MAX)), DBL_MAX);
  EXPECT_EQ(toDouble(Rational(DBL_TRUE_MIN)), DBL_TRUE_MIN);
}

TEST(ToDouble, KeepsTheSignOfWhatADoubleCannotHold) {
  EXPECT_EQ(toDouble(parseRational("1e400")), DBL_MAX);
  EXPECT_EQ(toDouble(parseRational("-1e400")), -DBL_MAX);
  EXPECT_EQ(toDouble(parseRational("1e-400")), DBL_TRUE_MIN);
  EXPECT_EQ(toDouble(parseRational("-1e-400")), -DBL_TRUE_MIN);
}

}  // namespace exact_number_test
}  // namespace whirl_twin
