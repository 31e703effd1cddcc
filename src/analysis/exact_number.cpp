#include "analysis/exact_number.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "messages/input_error.h"

namespace whirl_twin {

namespace {

constexpr int kMaxDecimalExponent = 5000;

bool isDigit(char c) {
  return c >= '0' && c <= '9';
}

/// Moves past the digits at `at` and returns them.
std::string takeDigits(const std::string& text, std::size_t& at) {
  const std::size_t begin = at;
  while (at < text.size() && isDigit(text[at])) {
    ++at;
  }
  return text.substr(begin, at - begin);
}

/// Moves past a sign at `at`, if there is one; true if it is a minus.
bool takeSign(const std::string& text, std::size_t& at) {
  if (at < text.size() && (text[at] == '+' || text[at] == '-')) {
    return text[at++] == '-';
  }
  return false;
}

[[noreturn]] void reject(const std::string& expected, const std::string& found) {
  throw InputError(fmt::format("expected {}, found \"{}\"", expected, found));
}

ScaledFloat normalised(long double mantissa, std::int64_t exponent) {
  int shift = 0;
  const long double fraction = std::frexp(mantissa, &shift);
  return {fraction, mantissa == 0.0L ? 0 : exponent + shift};
}

}  // namespace

Rational parseRational(const std::string& text) {
  const std::string expected = "a finite decimal number";
  std::size_t at = 0;
  const bool negative = takeSign(text, at);
  std::string digits = takeDigits(text, at);
  std::int64_t exponent = 0;
  if (at < text.size() && text[at] == '.') {
    const std::string fraction = takeDigits(text, ++at);
    digits += fraction;
    exponent = -static_cast<std::int64_t>(fraction.size());
  }
  if (digits.empty()) {
    reject(expected, text);
  }
  if (at < text.size() && (text[at] == 'e' || text[at] == 'E')) {
    const bool negative_exponent = takeSign(text, ++at);
    std::string power = takeDigits(text, at);
    if (power.empty()) {
      reject(expected, text);
    }
    power.erase(0, std::min(power.find_first_not_of('0'), power.size() - 1));
    if (power.size() > 4 || std::stoi(power) > kMaxDecimalExponent) {
      reject(fmt::format("a decimal exponent between -{0} and {0}", kMaxDecimalExponent), text);
    }
    exponent += negative_exponent ? -std::stoi(power) : std::stoi(power);
  }
  if (at != text.size()) {
    reject(expected, text);
  }
  // A leading zero would make the digits octal.
  digits.erase(0, std::min(digits.find_first_not_of('0'), digits.size() - 1));
  const Integer mantissa(digits);
  const Integer power = boost::multiprecision::pow(Integer(10), std::abs(exponent));
  const Rational magnitude = exponent < 0 ? Rational(mantissa, power) : Rational(mantissa * power);
  return negative ? Rational(-magnitude) : magnitude;
}

ComplexRational parseComplex(const std::string& text) {
  if (text.empty() || (text.back() != 'i' && text.back() != 'j')) {
    return {parseRational(text), 0};
  }
  const std::string body = text.substr(0, text.size() - 1);
  // The imaginary part begins at the last sign that does not belong to an exponent.
  std::size_t begin = 0;
  for (std::size_t i = 1; i < body.size(); ++i) {
    if ((body[i] == '+' || body[i] == '-') && body[i - 1] != 'e' && body[i - 1] != 'E') {
      begin = i;
    }
  }
  std::string imaginary = body.substr(begin);
  if (imaginary.empty() || imaginary == "+" || imaginary == "-") {
    imaginary += '1';
  }
  try {
    return {begin == 0 ? Rational(0) : parseRational(body.substr(0, begin)),
            parseRational(imaginary)};
  } catch (const InputError&) {
    reject("a finite decimal or complex number such as 3, 2i or 3+2i", text);
  }
}

void ExactBudget::spendOn(const Integer& number) {
  const auto words = static_cast<double>(number.backend().size());
  left_ -= words * words;
  if (left_ < 0.0) {
    throw ExactBudgetSpent();
  }
}

ScaledFloat scaledFloat(const Integer& value) {
  if (value == 0) {
    return {};
  }
  const Integer magnitude = abs(value);
  const auto bits = static_cast<std::int64_t>(msb(magnitude)) + 1;
  const std::int64_t dropped = std::max<std::int64_t>(0, bits - 64);
  const auto leading = static_cast<std::uint64_t>(Integer(magnitude >> dropped));
  const auto mantissa = static_cast<long double>(leading);
  return normalised(value < 0 ? -mantissa : mantissa, dropped);
}

ScaledFloat operator*(const ScaledFloat& a, const ScaledFloat& b) {
  return normalised(a.mantissa * b.mantissa, a.exponent + b.exponent);
}

ScaledFloat operator/(const ScaledFloat& a, const ScaledFloat& b) {
  return normalised(a.mantissa / b.mantissa, a.exponent - b.exponent);
}

double toDouble(const ScaledFloat& value) {
  if (value.mantissa == 0.0L) {
    return 0.0;
  }
  constexpr std::int64_t kBeyond = 2000;  // outside the exponents of double, inside those of int
  const auto exponent = static_cast<int>(std::clamp(value.exponent, -kBeyond, kBeyond));
  const auto magnitude = static_cast<double>(std::ldexp(std::fabs(value.mantissa), exponent));
  const double representable = std::clamp(magnitude, std::numeric_limits<double>::denorm_min(),
                                          std::numeric_limits<double>::max());
  return value.mantissa < 0.0L ? -representable : representable;
}

double toDouble(const Rational& value) {
  return toDouble(scaledFloat(numerator(value)) / scaledFloat(denominator(value)));
}

}  // namespace whirl_twin
