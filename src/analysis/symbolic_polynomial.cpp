#include "analysis/symbolic_polynomial.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "messages/input_error.h"

namespace whirl_twin {

namespace {

constexpr int kMaxPower = 20;          // of the symbol, that is read
constexpr std::size_t kMaxExact = 16;  // digits of a fraction, that are shown

void trim(std::vector<Rational>& entry) {
  while (!entry.empty() && entry.back() == 0) {
    entry.pop_back();
  }
}

SymbolicPolynomial scaled(SymbolicPolynomial p, const Rational& factor) {
  for (Rational& entry : p.entry) {
    entry *= factor;
  }
  return p;
}

/// What makes all its coefficients whole, without a common factor.
Rational wholeFactor(const std::vector<const SymbolicPolynomial*>& polynomials) {
  Integer denominators = 1;
  for (const SymbolicPolynomial* p : polynomials) {
    for (const Rational& entry : p->entry) {
      denominators *= denominator(entry) / gcd(denominators, denominator(entry));
    }
  }
  Integer common = 0;
  for (const SymbolicPolynomial* p : polynomials) {
    for (const Rational& entry : p->entry) {
      common = gcd(common, Integer(numerator(entry) * (denominators / denominator(entry))));
    }
  }
  return common == 0 ? Rational(1) : Rational(denominators, common);
}

/// Reads an expression from left to right.
class Expression {
 public:
  Expression(const std::string& text, const std::string& symbol) : text_(text), symbol_(symbol) {}

  SymbolicPolynomial whole() {
    SymbolicPolynomial value = sum();
    if (next() != '\0') {
      reject();
    }
    return value;
  }

 private:
  SymbolicPolynomial sum() {
    SymbolicPolynomial value = signedTerm();
    while (next() == '+' || next() == '-') {
      value = text_[at_] == '+' ? (++at_, value + term()) : (++at_, value - term());
    }
    return value;
  }
  SymbolicPolynomial signedTerm() {
    if (next() == '+' || next() == '-') {
      const bool minus = text_[at_++] == '-';
      return minus ? Rational(-1) * term() : term();
    }
    return term();
  }
  SymbolicPolynomial term() {
    SymbolicPolynomial value = power();
    while (true) {
      const char sign = next();
      if (sign == '/') {
        ++at_;
        const SymbolicPolynomial below = power();
        if (below.zero() || !below.constant()) {
          reject();
        }
        value = scaled(value, 1 / below.entry.front());
      } else if (sign == '*') {
        ++at_;
        value = value * power();
      } else if (sign == '(' || startsSymbol()) {
        value = value * power();
      } else {
        return value;
      }
    }
  }
  SymbolicPolynomial power() {
    const SymbolicPolynomial base = factor();
    if (next() != '^') {
      return base;
    }
    ++at_;
    next();
    const std::string digits = takeWhile([](char c) { return std::isdigit(c) != 0; });
    if (digits.empty() || digits.size() > 2 || std::stoi(digits) > kMaxPower) {
      reject();
    }
    SymbolicPolynomial value = Rational(1);
    for (int i = 0; i < std::stoi(digits); ++i) {
      value = value * base;
    }
    return value;
  }
  SymbolicPolynomial factor() {
    if (next() == '(') {
      ++at_;
      SymbolicPolynomial value = sum();
      if (next() != ')') {
        reject();
      }
      ++at_;
      return value;
    }
    if (startsSymbol()) {
      at_ += symbol_.size();
      return SymbolicPolynomial(std::vector<Rational>{0, 1});
    }
    return parseRational(number());
  }
  /// The letters of a decimal number, with its exponent.
  std::string number() {
    std::string letters = takeWhile([](char c) { return std::isdigit(c) != 0 || c == '.'; });
    if (letters.empty()) {
      reject();
    }
    const std::size_t mark = at_;
    if (at_ < text_.size() && (text_[at_] == 'e' || text_[at_] == 'E') && !startsSymbol()) {
      std::string exponent(1, text_[at_++]);
      if (at_ < text_.size() && (text_[at_] == '+' || text_[at_] == '-')) {
        exponent += text_[at_++];
      }
      const std::string digits = takeWhile([](char c) { return std::isdigit(c) != 0; });
      if (digits.empty()) {
        at_ = mark;
      } else {
        letters += exponent + digits;
      }
    }
    return letters;
  }
  template <class Is>
  std::string takeWhile(Is is) {
    const std::size_t begin = at_;
    while (at_ < text_.size() && is(text_[at_])) {
      ++at_;
    }
    return text_.substr(begin, at_ - begin);
  }
  bool startsSymbol() const {
    return !symbol_.empty() && text_.compare(at_, symbol_.size(), symbol_) == 0;
  }
  /// The next letter that is no space; 0 at the end.
  char next() {
    takeWhile([](char c) { return c == ' '; });
    return at_ < text_.size() ? text_[at_] : '\0';
  }
  [[noreturn]] void reject() const {
    throw InputError(fmt::format(
        "expected a finite decimal number, a fraction{}, found \"{}\"",
        symbol_.empty()
            ? " or a complex number such as 3+2i"
            : fmt::format(" or an expression of {0} such as 2{0}, ({0} + 1)/3 or {0}^2", symbol_),
        text_));
  }

  const std::string& text_;
  const std::string& symbol_;
  std::size_t at_ = 0;
};

/// Whole coefficients in brackets where there is more than one.
std::string bracketed(const SymbolicPolynomial& p, const std::string& symbol) {
  const auto terms = std::count_if(p.entry.begin(), p.entry.end(),
                                   [](const Rational& entry) { return entry != 0; });
  return terms > 1 ? fmt::format("({})", text(p, symbol)) : text(p, symbol);
}

}  // namespace

SymbolicPolynomial::SymbolicPolynomial(const Rational& constant) {
  if (constant != 0) {
    entry.push_back(constant);
  }
}

SymbolicPolynomial::SymbolicPolynomial(std::vector<Rational> entries) : entry(std::move(entries)) {
  trim(entry);
}

Rational SymbolicPolynomial::at(const Rational& x) const {
  Rational value = 0;
  for (auto it = entry.rbegin(); it != entry.rend(); ++it) {
    value = value * x + *it;
  }
  return value;
}

SymbolicPolynomial operator+(const SymbolicPolynomial& a, const SymbolicPolynomial& b) {
  std::vector<Rational> sum(std::max(a.entry.size(), b.entry.size()));
  for (std::size_t i = 0; i < sum.size(); ++i) {
    sum[i] = (i < a.entry.size() ? a.entry[i] : Rational(0)) +
             (i < b.entry.size() ? b.entry[i] : Rational(0));
  }
  return SymbolicPolynomial(std::move(sum));
}

SymbolicPolynomial operator-(const SymbolicPolynomial& a, const SymbolicPolynomial& b) {
  return a + scaled(b, -1);
}

SymbolicPolynomial operator*(const SymbolicPolynomial& a, const SymbolicPolynomial& b) {
  if (a.zero() || b.zero()) {
    return {};
  }
  std::vector<Rational> product(a.entry.size() + b.entry.size() - 1);
  for (std::size_t i = 0; i < a.entry.size(); ++i) {
    for (std::size_t j = 0; j < b.entry.size(); ++j) {
      product[i + j] += a.entry[i] * b.entry[j];
    }
  }
  return SymbolicPolynomial(std::move(product));
}

bool operator==(const SymbolicPolynomial& a, const SymbolicPolynomial& b) {
  return a.entry == b.entry;
}

std::pair<SymbolicPolynomial, SymbolicPolynomial> divided(const SymbolicPolynomial& a,
                                                          const SymbolicPolynomial& b) {
  std::vector<Rational> rest = a.entry;
  std::vector<Rational> quotient(
      a.entry.size() >= b.entry.size() ? a.entry.size() - b.entry.size() + 1 : 0);
  for (std::size_t k = quotient.size(); k-- > 0;) {
    quotient[k] = rest[k + b.entry.size() - 1] / b.entry.back();
    for (std::size_t j = 0; j < b.entry.size(); ++j) {
      rest[k + j] -= quotient[k] * b.entry[j];
    }
  }
  return {SymbolicPolynomial(std::move(quotient)), SymbolicPolynomial(std::move(rest))};
}

SymbolicPolynomial greatestCommonDivisor(SymbolicPolynomial a, SymbolicPolynomial b) {
  while (!b.zero()) {
    SymbolicPolynomial rest = divided(a, b).second;
    a = std::move(b);
    b = rest.zero() ? rest : scaled(rest, 1 / rest.entry.back());
  }
  return a.zero() ? a : scaled(a, 1 / a.entry.back());
}

SymbolicPolynomial derivative(const SymbolicPolynomial& polynomial) {
  std::vector<Rational> slope;
  for (std::size_t i = 1; i < polynomial.entry.size(); ++i) {
    slope.push_back(polynomial.entry[i] * i);
  }
  return SymbolicPolynomial(std::move(slope));
}

SymbolicPolynomial squareFree(const SymbolicPolynomial& polynomial) {
  return polynomial.constant()
             ? polynomial
             : divided(polynomial, greatestCommonDivisor(polynomial, derivative(polynomial))).first;
}

std::string text(const Rational& number) {
  const std::string exact = number.str();
  return exact.size() <= kMaxExact ? exact : fmt::format("{:.6g}", toDouble(number));
}

std::string text(const SymbolicPolynomial& polynomial, const std::string& symbol) {
  std::string out;
  for (std::size_t k = polynomial.entry.size(); k-- > 0;) {
    const Rational& entry = polynomial.entry[k];
    if (entry == 0) {
      continue;
    }
    const Rational size = abs(entry);
    out += out.empty() ? (entry < 0 ? "-" : "") : (entry < 0 ? " - " : " + ");
    out += size == 1 && k > 0 ? "" : text(size) + (k > 0 ? " " : "");
    out += k == 0 ? "" : k == 1 ? symbol : fmt::format("{}^{}", symbol, k);
  }
  return out.empty() ? "0" : out;
}

SymbolicPolynomial parseSymbolic(const std::string& text, const std::string& symbol) {
  return Expression(text, symbol).whole();
}

SymbolicQuotient::SymbolicQuotient(const SymbolicPolynomial& whole)
    : SymbolicQuotient(whole, Rational(1)) {}

SymbolicQuotient::SymbolicQuotient(const SymbolicPolynomial& above,
                                   const SymbolicPolynomial& below) {
  const SymbolicPolynomial common = greatestCommonDivisor(above, below);
  numerator = divided(above, common).first;
  denominator = divided(below, common).first;
  Rational factor = wholeFactor({&numerator, &denominator});
  factor = denominator.entry.back() < 0 ? Rational(-factor) : factor;
  numerator = scaled(numerator, factor);
  denominator = scaled(denominator, factor);
}

SymbolicQuotient operator+(const SymbolicQuotient& a, const SymbolicQuotient& b) {
  return {a.numerator * b.denominator + b.numerator * a.denominator, a.denominator * b.denominator};
}

SymbolicQuotient operator-(const SymbolicQuotient& a, const SymbolicQuotient& b) {
  return {a.numerator * b.denominator - b.numerator * a.denominator, a.denominator * b.denominator};
}

SymbolicQuotient operator*(const SymbolicQuotient& a, const SymbolicQuotient& b) {
  return {a.numerator * b.numerator, a.denominator * b.denominator};
}

SymbolicQuotient operator/(const SymbolicQuotient& a, const SymbolicQuotient& b) {
  return {a.numerator * b.denominator, a.denominator * b.numerator};
}

std::string text(const SymbolicQuotient& quotient, const std::string& symbol) {
  if (quotient.numerator.constant() && quotient.denominator.constant()) {
    return text(Rational(quotient.numerator.at(0) / quotient.denominator.at(0)));
  }
  if (quotient.denominator == SymbolicPolynomial(Rational(1))) {
    return text(quotient.numerator, symbol);
  }
  return bracketed(quotient.numerator, symbol) + "/" + bracketed(quotient.denominator, symbol);
}

}  // namespace whirl_twin
