// The reference polynomials of tests/reference: exact decimal strings, highest power first, with
// counts found by gcd(p(s), p(-s)) and Sturm sequences and checked with roots to 260 digits.
#pragma once

#include <gtest/gtest.h>

#include <cctype>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "analysis/exact_number.h"

namespace whirl_twin {

inline std::vector<nlohmann::json> referenceCases(const std::string& file) {
  const std::string path = std::string(WHIRL_TWIN_REFERENCE) + "/" + file;
  std::ifstream stream(path);
  if (!stream) {
    throw std::runtime_error("cannot read " + path);
  }
  return nlohmann::json::parse(stream).get<std::vector<nlohmann::json>>();
}

/// A name that gtest accepts and that identifies the case.
inline std::string testName(std::string text) {
  for (char& c : text) {
    if (c == '-') {
      c = 'm';
    } else if (std::isalnum(static_cast<unsigned char>(c)) == 0) {
      c = '_';
    }
  }
  return text;
}

inline std::vector<Rational> exactCoefficients(const nlohmann::json& strings) {
  std::vector<Rational> coefficients;
  for (const std::string text : strings) {
    coefficients.push_back(parseRational(text));
  }
  return coefficients;
}

inline std::vector<double> roundedCoefficients(const nlohmann::json& strings) {
  std::vector<double> coefficients;
  for (const std::string text : strings) {
    coefficients.push_back(std::stod(text));
  }
  return coefficients;
}

/// A number kept as text for its digits; NaN if it is null.
inline double numberOf(const nlohmann::json& text) {
  return text.is_null() ? std::numeric_limits<double>::quiet_NaN()
                        : std::stod(text.get<std::string>());
}

/// (a) times (b), highest power first.
template <typename Number>
std::vector<Number> product(const std::vector<Number>& a, const std::vector<Number>& b) {
  std::vector<Number> result(a.size() + b.size() - 1);
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t j = 0; j < b.size(); ++j) {
      result[i + j] += a[i] * b[j];
    }
  }
  return result;
}

}  // namespace whirl_twin
