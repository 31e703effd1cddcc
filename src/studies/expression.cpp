#include "studies/expression.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>

#include "algebra/constants.h"
#include "messages/input_error.h"
#include "messages/names.h"
#include "scene/node_reader.h"

namespace whirl_twin {

namespace {

constexpr int kDeepest = 100;  // nesting of brackets
constexpr std::size_t kLongest = 2000;
constexpr double kSettled = 0.02;  // default, relative to the largest deviation

const std::vector<std::string>& functionNames() {
  static const std::vector<std::string> names{"abs", "sqrt", "log"};
  return names;
}

template <class Names>
std::size_t placeOf(const std::string& name, const Names& names) {
  return static_cast<std::size_t>(std::find(names.begin(), names.end(), name) - names.begin());
}

}  // namespace

const std::vector<std::string>& reductionNames() {
  static const std::vector<std::string> names{
      "max",     "min",   "mean",        "rms",     "peak", "range", "standard_deviation",
      "initial", "final", "time_of_max", "settling"};
  return names;
}

class ExpressionParser {
 public:
  ExpressionParser(const std::string& text, Expression& into) : text_(text), into_(into) {}

  void parse() {
    if (text_.size() > kLongest) {
      throw InputError(fmt::format("must be an expression of up to {} characters", kLongest));
    }
    sum();
    skip();
    if (at_ != text_.size()) {
      fail("an operator or the end");
    }
  }

 private:
  using Operation = Expression::Operation;

  [[noreturn]] void fail(const std::string& expected) const {
    throw InputError(fmt::format("must have {} at character {}, found {}", expected, at_ + 1,
                                 at_ >= text_.size() ? "the end" : inQuotes(text_.substr(at_))));
  }
  void skip() {
    while (at_ < text_.size() && (text_[at_] == ' ' || text_[at_] == '\t')) {
      ++at_;
    }
  }
  bool taken(char c) {
    skip();
    if (at_ < text_.size() && text_[at_] == c) {
      ++at_;
      return true;
    }
    return false;
  }
  void require(char c) {
    if (!taken(c)) {
      fail(fmt::format("'{}'", c));
    }
  }
  void add(Operation operation) { into_.steps_.push_back({operation, 0.0, 0}); }

  void sum() {
    product();
    while (true) {
      if (taken('+')) {
        product();
        add(Operation::kAdd);
      } else if (taken('-')) {
        product();
        add(Operation::kSubtract);
      } else {
        return;
      }
    }
  }
  void product() {
    factor();
    while (true) {
      if (taken('*')) {
        factor();
        add(Operation::kMultiply);
      } else if (taken('/')) {
        factor();
        add(Operation::kDivide);
      } else {
        return;
      }
    }
  }
  void factor() {
    if (++depth_ > kDeepest) {
      throw InputError(fmt::format("must be nested at most {} levels deep", kDeepest));
    }
    if (taken('-')) {
      factor();
      add(Operation::kNegate);
    } else {
      primary();
      if (taken('^')) {
        factor();
        add(Operation::kPower);
      }
    }
    --depth_;
  }
  void primary() {
    skip();
    if (taken('(')) {
      sum();
      require(')');
      return;
    }
    const char c = at_ < text_.size() ? text_[at_] : '\0';
    if (std::isdigit(static_cast<unsigned char>(c)) != 0 || c == '.') {
      into_.steps_.push_back({Operation::kNumber, number(), 0});
    } else if (std::isalpha(static_cast<unsigned char>(c)) != 0) {
      named();
    } else {
      fail("a number, a name or '('");
    }
  }
  double number() {
    skip();
    std::size_t end = at_;
    const auto part = [&](char c) {
      return std::isdigit(static_cast<unsigned char>(c)) != 0 || c == '.' || c == 'e' || c == 'E' ||
             ((c == '-' || c == '+') && end > at_ &&
              (text_[end - 1] == 'e' || text_[end - 1] == 'E'));
    };
    while (end < text_.size() && part(text_[end])) {
      ++end;
    }
    const auto value = parseNumber(text_.substr(at_, end - at_));
    if (!value) {
      fail("a number");
    }
    at_ = end;
    return *value;
  }
  std::string path() {
    skip();
    const std::size_t begin = at_;
    while (at_ < text_.size() && (isNameCharacter(text_[at_]) || text_[at_] == '.' ||
                                  text_[at_] == '[' || text_[at_] == ']')) {
      ++at_;
    }
    if (at_ == begin) {
      fail("a name");
    }
    return text_.substr(begin, at_ - begin);
  }
  void named() {
    const std::size_t begin = at_;
    const std::string name = path();
    if (!taken('(')) {
      leaf({"", name, 0.0});
      return;
    }
    if (const std::size_t place = placeOf(name, functionNames()); place < functionNames().size()) {
      sum();
      require(')');
      add(static_cast<Operation>(static_cast<std::size_t>(Operation::kAbs) + place));
      return;
    }
    if (placeOf(name, reductionNames()) == reductionNames().size()) {
      std::vector<std::string> known = reductionNames();
      known.insert(known.end(), functionNames().begin(), functionNames().end());
      throw InputError(fmt::format("unknown function {} at character {}{}", inQuotes(name),
                                   begin + 1, hint(name, known)));
    }
    ExpressionLeaf found{name, path(), kSettled};
    if (taken(',')) {
      if (name != "settling") {
        throw InputError(name + " has one argument, the quantity");
      }
      found.argument = number();
      if (!(found.argument > 0.0 && found.argument < 1.0)) {
        throw InputError("settling: the band must be > 0 and < 1, a part of the largest deviation");
      }
    }
    require(')');
    leaf(found);
  }
  void leaf(const ExpressionLeaf& found) {
    into_.steps_.push_back({Operation::kLeaf, 0.0, into_.leaves_.size()});
    into_.leaves_.push_back(found);
  }

  const std::string& text_;
  Expression& into_;
  std::size_t at_ = 0;
  int depth_ = 0;
};

Expression::Expression(const std::string& text) {
  ExpressionParser(text, *this).parse();
}

double Expression::value(const std::vector<double>& leaves) const {
  std::vector<double> stack;
  const auto pop = [&] {
    const double top = stack.back();
    stack.pop_back();
    return top;
  };
  for (const Step& step : steps_) {
    if (step.operation == Operation::kNumber || step.operation == Operation::kLeaf) {
      stack.push_back(step.operation == Operation::kNumber ? step.number : leaves[step.leaf]);
      continue;
    }
    const double b = pop();
    switch (step.operation) {
      case Operation::kAdd:
        stack.back() += b;
        break;
      case Operation::kSubtract:
        stack.back() -= b;
        break;
      case Operation::kMultiply:
        stack.back() *= b;
        break;
      case Operation::kDivide:
        stack.back() /= b;
        break;
      case Operation::kPower:
        stack.back() = std::pow(stack.back(), b);
        break;
      case Operation::kNegate:
        stack.push_back(-b);
        break;
      case Operation::kAbs:
        stack.push_back(std::fabs(b));
        break;
      case Operation::kSqrt:
        stack.push_back(std::sqrt(b));
        break;
      default:
        stack.push_back(std::log(b));
    }
  }
  return stack.back();
}

Reduction::Reduction(const std::string& name, double argument)
    : kind_(static_cast<Kind>(placeOf(name, reductionNames()))), argument_(argument) {}

void Reduction::take(double time, double value) {
  if (count_++ == 0) {
    first_ = least_ = most_ = value;
    time_of_most_ = time;
  }
  last_ = value;
  if (value > most_) {
    most_ = value;
    time_of_most_ = time;
  }
  least_ = std::min(least_, value);
  const double off = value - mean_;
  mean_ += off / static_cast<double>(count_);
  squares_ += off * (value - mean_);
  if (kind_ == Kind::kSettling) {
    times_.push_back(time);
    values_.push_back(value);
  }
}

double Reduction::settling() const {
  double largest = 0.0;
  for (const double value : values_) {
    largest = std::max(largest, std::fabs(value - last_));
  }
  std::size_t from = values_.size();
  while (from > 0 && std::fabs(values_[from - 1] - last_) <= argument_ * largest) {
    --from;
  }
  // The last value is in the band by definition: it alone does not count.
  if (from + 1 == values_.size() && values_.size() > 1) {
    return kNaN;
  }
  return times_[from] - times_[0];
}

double Reduction::result() const {
  if (count_ == 0) {
    return kNaN;
  }
  const double variance = squares_ / static_cast<double>(count_);
  switch (kind_) {
    case Kind::kMax:
      return most_;
    case Kind::kMin:
      return least_;
    case Kind::kMean:
      return mean_;
    case Kind::kRms:
      return std::sqrt(variance + mean_ * mean_);
    case Kind::kPeak:
      return std::max(std::fabs(most_), std::fabs(least_));
    case Kind::kRange:
      return most_ - least_;
    case Kind::kDeviation:
      return std::sqrt(variance);
    case Kind::kInitial:
      return first_;
    case Kind::kFinal:
      return last_;
    case Kind::kTimeOfMax:
      return time_of_most_;
    default:
      return settling();
  }
}

}  // namespace whirl_twin
