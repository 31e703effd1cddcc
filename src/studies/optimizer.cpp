#include "studies/optimizer.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>
#include <nlopt.hpp>
#include <random>
#include <utility>

#include "algebra/constants.h"
#include "messages/input_error.h"

namespace whirl_twin {

namespace {

constexpr double kFirstStep = 0.2;  // of each range
constexpr int kMaxRestarts = 20;
constexpr double kGain = 1.0e-6;  // minimum gain, relative to the spread of all values

nlopt::algorithm algorithmOf(const std::string& method) {
  return method == "bobyqa"   ? nlopt::LN_BOBYQA
         : method == "cobyla" ? nlopt::LN_COBYLA
         : method == "crs"    ? nlopt::GN_CRS2_LM
                              : nlopt::GN_ISRES;
}

class Search {
 public:
  Search(const Study& study, const StepsChosen& steps, const std::atomic<bool>& stop,
         const std::function<void(std::uint64_t)>& done)
      : study_(study), asked_(*study.optimization), evaluator_(study, steps, stop), done_(done) {}

  Optimum run() {
    std::vector<double> parts;
    for (const std::size_t j : asked_.over) {
      parts.push_back(startOf(study_.vary[j]));
    }
    found_.start = valuesOf(parts);
    const unsigned dimensions = static_cast<unsigned>(parts.size());
    nlopt::opt search(algorithmOf(asked_.method), dimensions);
    nlopt::srand(study_.seed);
    search.set_lower_bounds(0.0);
    search.set_upper_bounds(1.0);
    search.set_initial_step(kFirstStep);
    search.set_xtol_abs(asked_.tolerance);
    search.set_min_objective(objective, this);
    std::vector<Constraint> constraints;
    constraints.reserve(study_.requirements.size());
    for (const Requirement& requirement : study_.requirements) {
      constraints.push_back({this, requirement});
      search.add_inequality_constraint(constraint, &constraints.back(), 0.0);
    }
    try {
      at(parts);
      requireStart();
      endWith(search, parts);
      const bool local = asked_.method == "bobyqa" || asked_.method == "cobyla";
      for (int k = 0; local && findsBetter(parts); ++k) {
        if (k == kMaxRestarts) {
          found_.converged = false;
          found_.ended = fmt::format(
              "better points were found near each of the {} end points: the optimum lies along a "
              "ridge (`method: crs`)",
              kMaxRestarts + 1);
          break;
        }
        endWith(search, parts);
      }
    } catch (const nlopt::forced_stop&) {  // the reason has been recorded
    }
    if (error_) {
      std::rethrow_exception(error_);
    }
    return found_;
  }

 private:
  struct Seen {
    Outcome outcome = {};
    double cost = 0.0;  // to be minimized; finite
  };
  struct Constraint {
    Search* search;
    Requirement requirement;
  };

  static double objective(const std::vector<double>& parts, std::vector<double>& /*gradient*/,
                          void* self) {
    return static_cast<Search*>(self)->at(parts).cost;
  }
  /// At most 0 if the requirement is met.
  static double constraint(const std::vector<double>& parts, std::vector<double>& /*gradient*/,
                           void* of) {
    const auto& [search, requirement] = *static_cast<const Constraint*>(of);
    const Outcome& outcome = search->at(parts).outcome;
    if (!outcome.failure.empty() || std::isnan(outcome.measures[requirement.measure])) {
      return 1.0;
    }
    const bool below =
        requirement.is == Requirement::Is::kBelow || requirement.is == Requirement::Is::kAtMost;
    const double scale = requirement.limit != 0.0 ? std::fabs(requirement.limit) : 1.0;
    const double beyond = (outcome.measures[requirement.measure] - requirement.limit) / scale;
    return std::clamp(below ? beyond : -beyond, -1.0e6, 1.0e6);
  }

  /// Nominal value, if within the range; else the middle.
  static double startOf(const Variation& variation) {
    const Distribution& d = variation.distribution;
    if (!(variation.nominal >= d.smallest() && variation.nominal <= d.largest())) {
      return 0.5;
    }
    const bool logarithmic = d.kind == Distribution::Kind::kLogUniform;
    const auto place = [logarithmic](double x) { return logarithmic ? std::log(x) : x; };
    return std::clamp((place(variation.nominal) - place(d.smallest())) /
                          (place(d.largest()) - place(d.smallest())),
                      0.0, 1.0);
  }
  static double valueOf(const Distribution& d, double part) {
    if (d.kind == Distribution::Kind::kLogUniform) {
      return std::clamp(d.smallest() * std::pow(d.largest() / d.smallest(), part), d.smallest(),
                        d.largest());
    }
    return std::clamp(d.smallest() + part * (d.largest() - d.smallest()), d.smallest(),
                      d.largest());
  }
  std::vector<double> valuesOf(const std::vector<double>& parts) const {
    std::vector<double> values;
    for (const Variation& variation : study_.vary) {
      values.push_back(variation.nominal);
    }
    for (std::size_t i = 0; i < parts.size(); ++i) {
      values[asked_.over[i]] = valueOf(study_.vary[asked_.over[i]].distribution, parts[i]);
    }
    return values;
  }

  /// Objective and requirements are evaluated in turn at the same point: it is run once.
  const Seen& at(const std::vector<double>& parts) {
    if (parts == last_) {
      return seen_;
    }
    if (found_.evaluations >= asked_.evaluations) {
      stopWith(fmt::format("the limit of {} evaluations was reached", asked_.evaluations));
    }
    const std::vector<double> values = valuesOf(parts);
    Seen seen{evaluated(values), 0.0};
    if (found_.evaluations == 1) {
      found_.at_start = seen.outcome;
    }
    const bool failed = !seen.outcome.failure.empty();
    found_.failures += failed ? 1 : 0;
    double cost = failed ? std::nan("") : seen.outcome.measures[asked_.measure];
    cost = asked_.maximize ? -cost : cost;
    if (std::isnan(cost) || cost == kInfinity) {
      // Larger than all others, but finite, as required by the models of some methods.
      seen.cost = worst_ + (worst_ - best_) + std::fabs(worst_);
      return remember(parts, seen);
    }
    const bool meets = std::all_of(
        study_.requirements.begin(), study_.requirements.end(),
        [&](const Requirement& r) { return r.holds(seen.outcome.measures[r.measure]); });
    if (meets && (found_.values.empty() || cost < best_allowed_)) {
      best_allowed_ = cost;
      best_parts_ = parts;
      found_.values = values;
      found_.measures = seen.outcome.measures;
      if (std::isinf(cost)) {
        stopWith(fmt::format("{} is infinite there", study_.measures[asked_.measure].name));
      }
    }
    seen.cost = std::max(cost, -std::numeric_limits<double>::max());
    best_ = any_ ? std::min(best_, seen.cost) : seen.cost;
    worst_ = any_ ? std::max(worst_, seen.cost) : seen.cost;
    any_ = true;
    return remember(parts, seen);
  }
  /// Exceptions bypass NLopt, which would convert them into a failure.
  Outcome evaluated(const std::vector<double>& values) {
    try {
      Outcome outcome = evaluator_.at(values);
      done_(++found_.evaluations);
      return outcome;
    } catch (...) {
      error_ = std::current_exception();
      throw nlopt::forced_stop();
    }
  }
  const Seen& remember(const std::vector<double>& parts, Seen seen) {
    last_ = parts;
    seen_ = std::move(seen);
    return seen_;
  }

  void requireStart() const {
    if (!found_.at_start.failure.empty()) {
      throw RunFailure("optimize: at the start point: " + found_.at_start.failure);
    }
    const double value = found_.at_start.measures[asked_.measure];
    if (!(asked_.maximize ? value > -kInfinity : value < kInfinity)) {
      throw RunFailure(fmt::format("optimize: at the start point {} must be finite, found {}",
                                   study_.measures[asked_.measure].name, value));
    }
  }

  [[noreturn]] void stopWith(const std::string& why) {
    found_.ended = why;
    throw nlopt::forced_stop();
  }

  void endWith(nlopt::opt& search, std::vector<double>& parts) {
    double least = 0.0;
    try {
      const nlopt::result result = search.optimize(parts, least);
      found_.converged = result > 0 && result != nlopt::MAXEVAL_REACHED;
      found_.ended = fmt::format("steps are below {:g} of each range", asked_.tolerance);
    } catch (const nlopt::roundoff_limited&) {
      found_.converged = true;
      found_.ended = "no step improves it further";
    }
  }

  /// Local methods with linear or quadratic models stop on a ridge, for instance where two roots
  /// coincide: only few directions improve the measure there. Searches random directions from the
  /// best point for a better one.
  bool findsBetter(std::vector<double>& parts) {
    if (best_parts_.empty()) {
      return false;
    }
    const std::vector<double> from = best_parts_;
    const double needed = best_allowed_ - kGain * (worst_ - best_);
    for (const double radius : {0.1, 0.03, 0.01, 0.003}) {
      for (std::size_t k = 0; k < 2 * from.size() + 2; ++k) {
        std::vector<double> trial(from.size());
        double length = 0.0;
        for (double& x : trial) {
          x = normal_(random_);
          length = std::hypot(length, x);
        }
        for (std::size_t i = 0; i < trial.size(); ++i) {
          trial[i] = std::clamp(from[i] + radius * trial[i] / length, 0.0, 1.0);
        }
        at(trial);
        if (best_allowed_ < needed) {
          parts = best_parts_;
          return true;
        }
      }
    }
    return false;
  }

  const Study& study_;
  const Optimization& asked_;
  PointEvaluator evaluator_;
  const std::function<void(std::uint64_t)>& done_;
  std::vector<double> last_;        // last evaluated point
  std::vector<double> best_parts_;  // best point that meets the requirements
  std::mt19937_64 random_{study_.seed};
  std::normal_distribution<double> normal_;
  Seen seen_;  // result there
  Optimum found_;
  double best_ = 0.0, worst_ = 0.0, best_allowed_ = 0.0;
  bool any_ = false;
  std::exception_ptr error_;
};

}  // namespace

Optimum optimize(const Study& study, const StepsChosen& steps, const std::atomic<bool>& stop,
                 const std::function<void(std::uint64_t)>& done) {
  return Search(study, steps, stop, done).run();
}

}  // namespace whirl_twin
