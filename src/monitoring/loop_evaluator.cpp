#include <algorithm>
#include <cmath>
#include <complex>
#include <utility>

#include "algebra/constants.h"
#include "analysis/sampled_margins.h"
#include "messages/input_error.h"
#include "monitoring/stability_evaluator.h"

namespace whirl_twin {

namespace {

constexpr double kLoopSearchPeriod = 1.0;  // s, simulated
constexpr double kMovedNews = 1.0e-6;      // of coordinates, or m or rad

/// With these roots: highest power first.
std::vector<double> polynomialOf(const std::vector<std::complex<double>>& roots) {
  std::vector<std::complex<double>> product{1.0};
  for (const std::complex<double>& root : roots) {
    product.emplace_back(0.0);
    for (std::size_t i = product.size() - 1; i > 0; --i) {
      product[i] -= root * product[i - 1];
    }
  }
  std::vector<double> real;
  for (const std::complex<double>& coefficient : product) {
    real.push_back(coefficient.real());
  }
  return real;
}

/// Sensitivities are those of each sensor alone, as ISO 14839-3 measures them. What the loop bears
/// is the least of any sensor alone and of all at once.
void setMargins(const LoopMargins& at_once, const std::vector<SampledMargins>& found,
                state::ControllerMargins& margins) {
  const LoopMargins alone = leastMargins(found.front(), found);
  margins.sensitivity_peak = alone.sensitivity_peak;
  margins.peak_frequency = alone.peak_frequency;
  margins.zone = name(alone.zone);
  const LoopMargins least = leastMargins(at_once, found);
  margins.gain_margin = least.gain_margin;
  margins.gain_reduction = least.gain_reduction;
  margins.phase_margin = least.phase_margin;
  margins.phase_crossover = least.phase_crossover;
  margins.delay_margin = least.delay_margin;
  for (std::size_t i = 0; i < found.size(); ++i) {
    margins.signal_peak[i] = found[i].sensitivity_peak;
    margins.signal_frequency[i] = found[i].peak_frequency;
  }
}

/// As before anything is known.
state::ControllerMargins unknownMargins(const ControllerSpec& controller) {
  state::ControllerMargins margins;
  margins.controller = controller.name;
  margins.verdict_name = name(Verdict::kUncertain);
  margins.signal = controller.measured;
  margins.signal_peak.assign(controller.measured.size(), kNaN);
  margins.signal_frequency = margins.signal_peak;
  return margins;
}

}  // namespace

LoopEvaluator::LoopEvaluator(SharedSystem system, std::shared_ptr<const ClosedLoop> loop)
    : system_(std::move(system)), loop_(std::move(loop)) {
  const std::vector<std::size_t> all = loop_->systems();
  place_ = *std::find_if(all.begin(), all.end(), [&](std::size_t place) {
    return loop_->nameOf(place) == system_->spec.name;
  });
}

Stability LoopEvaluator::evaluate(double time, const SystemMotion& present,
                                  const SystemMotions& beside, Eigen::VectorXd& about) {
  parts_.reset();
  try {
    return evaluateOrThrow(time, present, beside, about);
  } catch (const std::exception& failure) {
    found_.reset();
    margins_.clear();
    for (std::size_t i = 0; i < loop_->controllers().size(); ++i) {
      margins_.push_back(unknownMargins(loop_->controller(i)));
      margins_.back().objection = failure.what();
    }
    throw;
  }
}

Stability LoopEvaluator::evaluateOrThrow(double time, const SystemMotion& present,
                                         const SystemMotions& beside, Eigen::VectorXd& about) {
  const auto motionOf = [&](std::size_t system) {
    return system == place_ ? present : beside(system);
  };
  const double speed = motionOf(loop_->leadingSystem()).speed;
  auto parts = loop_->parts(motionOf, speed);
  if (!parts) {
    throw LoopNotLinear("a control law of the loop is not linear");
  }
  Eigen::VectorXd motion;
  for (const auto& [place, held] : parts->about) {
    const Eigen::Index before = motion.size(), n = held.q.size();
    motion.conservativeResize(before + 2 * n);
    // Wherever the trim of a linear system is, its small motions are the same.
    if (held.dynamics->linear()) {
      motion.segment(before, n).setZero();
    } else {
      motion.segment(before, n) = held.q;
    }
    motion.tail(n) = held.v;
    if (place == place_) {
      about = motion.segment(before, n);
    }
  }
  const SampledLoop sampled = sampledLoop(parts->plant, parts->controllers);
  const SampledStability loop = sampledStability(sampled);
  parts_ = std::move(parts);
  last_ = {time, speed, motion, loop.verdict, parts_->holding};
  if (!found_ || found_->verdict != loop.verdict || found_->holding != last_.holding) {
    found_.reset();
    margins_.clear();
    for (std::size_t i = 0; i < loop_->controllers().size(); ++i) {
      margins_.push_back(unknownMargins(loop_->controller(i)));
    }
  }
  for (state::ControllerMargins& margins : margins_) {
    margins.verdict = static_cast<std::uint8_t>(loop.verdict);
    margins.verdict_name = name(loop.verdict);
    margins.speed = motionOf(loop_->leadingSystem()).dynamics->hasShaft() ? speed : kNaN;
    margins.spectral_radius = loop.spectral_radius;
    margins.period = sampled.period;
  }

  Stability s;
  s.routh = loop.routh;
  s.routh.verdict = loop.verdict;
  s.polynomial = polynomialOf(loop.eigenvalues);
  s.right_by_eigenvalues = loop.routh.right;
  // The slowest in continuous time: z = e^(s T).
  const std::complex<double> slowest = std::log(loop.eigenvalues.front()) / sampled.period;
  s.decay_rate = -slowest.real();
  s.damping_ratio = std::abs(slowest) > 0.0 ? s.decay_rate / std::abs(slowest) : 0.0;
  s.log_decrement =
      slowest.imag() != 0.0 ? kTwoPi * s.decay_rate / std::fabs(slowest.imag()) : kNaN;
  return s;
}

bool LoopEvaluator::lacksMargins() const {
  if (!reports() || !parts_ || last_.verdict == Verdict::kUncertain) {
    return false;
  }
  if (!found_) {
    return true;
  }
  const double since = last_.time - found_->time;  // back after a reset
  const bool news =
      std::fabs(last_.speed - found_->speed) > kSpeedNews * std::fabs(found_->speed) ||
      !((last_.about - found_->about).norm() <= kMovedNews * (1.0 + found_->about.norm()));
  return news && (since < 0.0 || since >= kLoopSearchPeriod);
}

void LoopEvaluator::findMargins() {
  found_ = last_;
  std::optional<LoopMargins> at_once;  // of all controllers
  for (std::size_t i = 0; i < margins_.size(); ++i) {
    try {
      const auto alone = sampledMargins(parts_->plant, parts_->controllers, i, last_.verdict);
      if (!at_once) {
        at_once = sampledMarginsAtOnce(parts_->plant, parts_->controllers, last_.verdict);
      }
      setMargins(*at_once, alone, margins_[i]);
    } catch (const RunFailure& failure) {
      const state::ControllerMargins verdict = margins_[i];
      margins_[i] = unknownMargins(loop_->controller(i));
      margins_[i].verdict = verdict.verdict;
      margins_[i].verdict_name = verdict.verdict_name;
      margins_[i].objection = failure.what();
    }
  }
}

std::vector<state::ControllerMargins> LoopEvaluator::margins() const {
  return reports() ? margins_ : std::vector<state::ControllerMargins>{};
}

}  // namespace whirl_twin
