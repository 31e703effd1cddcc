#include "requests/routh_request.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <complex>
#include <limits>
#include <optional>

#include "analysis/polynomial_roots.h"
#include "analysis/routh.h"
#include "analysis/stability_margins.h"
#include "messages/input_error.h"
#include "reports/asked_cost.h"
#include "reports/report_values.h"
#include "reports/routh_report.h"

namespace whirl_twin {

namespace {

constexpr double kExactBudget = 1.0e9;  // products of machine words: seconds
// maximum number of coefficients for which the table is shown
constexpr std::size_t kWidestTable = 31;

struct RouthJudgement {
  RouthResult routh;
  bool exact = true;  // else the counts are those of the roots
  std::vector<std::complex<double>> roots;
  double decay_rate = 0.0;
  double damping_ratio = 0.0;
  double log_decrement = 0.0;
};

/// Applies `parse` to each argument; collects the errors.
template <class Parse>
auto parseCoefficients(const std::vector<std::string>& typed, const Parse& parse) {
  std::vector<decltype(parse(typed.front()))> coefficients;
  std::vector<std::string> errors;
  for (std::size_t i = 0; i < typed.size(); ++i) {
    try {
      coefficients.push_back(parse(typed[i]));
    } catch (const InputError& error) {
      errors.push_back(
          fmt::format("coefficient {} (of s^{}): {}", i + 1, typed.size() - 1 - i, error.what()));
    }
  }
  if (!errors.empty()) {
    throw InputError(fmt::format("{}", fmt::join(errors, "\ntwin: ")));
  }
  return coefficients;
}

ComplexRational parseCoefficient(const std::string& typed) {
  const bool complex = !typed.empty() && (typed.back() == 'i' || typed.back() == 'j');
  return complex ? parseComplex(typed) : ComplexRational{parseSymbolic(typed, "").at(0), 0};
}

/// Scales numbers outside the range of double, as required by roots(); the roots do not change.
std::vector<std::complex<double>> coefficientsInRange(
    const std::vector<ComplexRational>& coefficients) {
  Rational largest = 0;
  Rational smallest = 0;
  for (const ComplexRational& c : coefficients) {
    for (const Rational& part : {Rational(abs(c.re)), Rational(abs(c.im))}) {
      largest = std::max(largest, part);
      smallest = part != 0 && (smallest == 0 || part < smallest) ? part : smallest;
    }
  }
  const bool fits = largest <= Rational(std::numeric_limits<double>::max()) &&
                    smallest >= Rational(std::numeric_limits<double>::min());
  std::vector<std::complex<double>> rounded;
  rounded.reserve(coefficients.size());
  for (const ComplexRational& c : coefficients) {
    rounded.emplace_back(fits ? toDouble(c.re) : toDouble(Rational(c.re / largest)),
                         fits ? toDouble(c.im) : toDouble(Rational(c.im / largest)));
  }
  return rounded;
}

/// Location of the computed roots; those within rounding of the axis count as on it.
RouthResult countsOf(const std::vector<std::complex<double>>& roots) {
  constexpr double kRounding = 1.0e-9;
  RouthResult counts;
  counts.verdict = Verdict::kUncertain;
  for (const auto& root : roots) {
    const double beside = kRounding * std::abs(root);
    ++(root.real() > beside    ? counts.right
       : root.real() < -beside ? counts.left
                               : counts.imaginary);
  }
  return counts;
}

RouthJudgement judge(const std::vector<ComplexRational>& coefficients, bool real) {
  const auto rounded = coefficientsInRange(coefficients);
  std::vector<Rational> exact;
  std::vector<double> values;
  for (std::size_t i = 0; i < coefficients.size(); ++i) {
    exact.push_back(coefficients[i].re);
    values.push_back(rounded[i].real());
  }
  RouthJudgement judgement;
  judgement.roots = real ? roots(values) : roots(rounded);
  if (!std::all_of(judgement.roots.begin(), judgement.roots.end(), [](const auto& root) {
        return std::isfinite(root.real()) && std::isfinite(root.imag());
      })) {
    throw InputError(
        "coefficients: a root exceeds 1.8e308, the largest double; use a larger unit for s");
  }
  ExactBudget budget(kExactBudget);
  try {
    judgement.routh = real ? routh(exact, budget) : routh(coefficients, budget);
  } catch (const ExactBudgetSpent&) {
    judgement.routh = countsOf(judgement.roots);
    judgement.exact = false;
  }
  return judgement;
}

/// The margins, with roots placed on the axis according to the exact test.
void addMargins(RouthJudgement& j) {
  double rightmost = -std::numeric_limits<double>::infinity();
  double ratio = std::numeric_limits<double>::quiet_NaN();
  int zeros = 0;
  for (const auto& root : j.roots) {
    rightmost = std::max(rightmost, root.real());
    if (root == 0.0) {
      ++zeros;
    } else {
      ratio = std::fmin(ratio, -root.real() / std::abs(root));
    }
  }
  const bool on_axis = j.routh.right == 0 && j.routh.imaginary > 0;
  j.decay_rate = on_axis ? 0.0 : -rightmost;
  j.damping_ratio = on_axis && j.routh.imaginary > zeros ? 0.0 : ratio;
  j.log_decrement = logDecrement(j.damping_ratio);
}

Json judgementJson(const RouthJudgement& j) {
  Json json;
  json["verdict"] = name(j.routh.verdict);
  json["right"] = j.routh.right;
  json["imaginary"] = j.routh.imaginary;
  json["left"] = j.routh.left;
  json["first_column"] = j.routh.first_column;
  json["decay_rate"] = j.decay_rate;
  json["damping_ratio"] = j.damping_ratio;
  json["log_decrement"] = j.log_decrement;
  json["degree"] = j.roots.size();
  json["roots"] = Json::array();
  for (const auto& root : j.roots) {
    json["roots"].push_back({root.real(), root.imag()});
  }
  return json;
}

/// Routh's table, if there is one, and the roots.
CsvTables judgementTables(const RouthJudgement& j, const std::optional<RouthTable>& table) {
  CsvTable roots{"roots", {"re", "im"}};
  for (const auto& root : j.roots) {
    roots.rows.push_back({{"re", root.real()}, {"im", root.imag()}});
  }
  return table ? CsvTables{csv(*table, ""), roots} : CsvTables{roots};
}

std::string judgementText(const RouthJudgement& j) {
  std::string out = fmt::format("{} (degree {})\n",
                                j.exact ? verdictText(j.routh.verdict)
                                        : "uncertain: the exact test was stopped, because its "
                                          "numbers become too long; as computed:",
                                j.roots.size());
  out += routhText(j.routh) + marginsText(j.decay_rate, j.damping_ratio, j.log_decrement);
  for (const auto& root : j.roots) {
    out += fmt::format("    root            {:.6g} {:+.6g}i\n", root.real(), root.imag());
  }
  return out;
}

/// Throws InputError unless it is a symbol that cannot be confused with a number.
void requireSymbol(const std::string& symbol) {
  const auto letter = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0; };
  const bool name =
      !symbol.empty() && std::isalpha(static_cast<unsigned char>(symbol[0])) != 0 &&
      std::all_of(symbol.begin(), symbol.end(), [&](char c) { return letter(c) || c == '_'; });
  if (!name || symbol == "e" || symbol == "E" || symbol == "s") {
    throw InputError(fmt::format(
        "--parameter: expected a name such as K (letters and digits, not e or s), found '{}'",
        symbol));
  }
}

Document documentForParameter(const RouthRequest& request) {
  const std::string& symbol = *request.parameter;
  requireSymbol(symbol);
  const std::vector<SymbolicPolynomial> coefficients = parseCoefficients(
      request.coefficients, [&](const std::string& typed) { return parseSymbolic(typed, symbol); });
  if (std::all_of(coefficients.begin(), coefficients.end(),
                  [](const SymbolicPolynomial& c) { return c.constant(); })) {
    throw InputError(fmt::format("--parameter: no coefficient contains {}", symbol));
  }
  ExactBudget budget(kExactBudget);
  const StabilityRange range = stabilityRange(coefficients, budget);
  const RouthTable table = routhTable(coefficients, symbol);
  Document document;
  document.json = json(range, symbol);
  document.json["table"] = json(table, symbol);
  document.text = text(range, symbol) + text(table, symbol);
  document.tables = {csv(table, symbol)};
  return document;
}

}  // namespace

Document routhDocument(const RouthRequest& request) {
  if (request.parameter) {
    return documentForParameter(request);
  }
  const std::vector<ComplexRational> coefficients =
      parseCoefficients(request.coefficients, parseCoefficient);
  if (std::all_of(coefficients.begin(), coefficients.end(),
                  [](const ComplexRational& c) { return c.re == 0 && c.im == 0; })) {
    throw InputError("coefficients: at least one must not be zero, found none");
  }
  const bool real = std::all_of(coefficients.begin(), coefficients.end(),
                                [](const ComplexRational& c) { return c.im == 0; });
  tell(costOfRoots(coefficients.size(), real), request.insist);
  RouthJudgement judgement = judge(coefficients, real);
  addMargins(judgement);
  std::optional<RouthTable> table;
  if (real && coefficients.size() <= kWidestTable) {
    std::vector<SymbolicPolynomial> numbers;
    for (const ComplexRational& c : coefficients) {
      numbers.emplace_back(c.re);
    }
    table = routhTable(numbers, "");
  }
  Document document;
  document.json = judgementJson(judgement);
  document.json["table"] = table ? json(*table, "") : Json();
  document.text = judgementText(judgement) + (table ? text(*table, "") : "");
  document.tables = judgementTables(judgement, table);
  return document;
}

}  // namespace whirl_twin
