#include "analysis/sampled_margins.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <stdexcept>
#include <utility>

#include "algebra/constants.h"
#include "algebra/dense.h"
#include "analysis/balanced_matrix.h"
#include "analysis/delayed_matrix.h"

namespace whirl_twin {

namespace {

using Complex = std::complex<double>;
using Eigen::Index;
using Eigen::MatrixXd;

/// Eigenvalues below it are those of delays, which have no frequency.
constexpr double kGoneInASample = 1e-6;

/// Frequencies for each state, where most of them are delays.
constexpr double kPointsOfState = 8.0;

/// The loop cut at a place.
std::vector<LoopController> opened(std::vector<LoopController> controllers,
                                   const LoopPlace& place) {
  DiscreteStateSpace& law = controllers.at(place.controller).law;
  if (place.at_output) {
    law.c.row(place.channel).setZero();
    law.d.row(place.channel).setZero();
  } else {
    law.b.col(place.channel).setZero();
    law.d.col(place.channel).setZero();
  }
  return controllers;
}

Eigen::VectorXcd balancedEigenvalues(const MatrixXd& transition) {
  return eigenvalues(balanced(transition)).values;
}

/// ln(z) / period, and what samples of it show as the same.
void addPoles(const Eigen::VectorXcd& eigenvalues, double period, int samples,
              std::vector<Complex>& poles) {
  for (const Complex& z : eigenvalues) {
    if (std::abs(z) > kGoneInASample) {
      const Complex pole = std::log(z) / period;
      for (int alias = 0; alias < samples; ++alias) {
        poles.push_back(pole + Complex(0.0, 2.0 * kPi * alias / period));
      }
    }
  }
}

/// F = D U T U^H D^-1 in Schur's form, D balancing units.
struct SchurForm {
  explicit SchurForm(const MatrixXd& transition) {
    if (transition.size() == 0) {
      return;
    }
    const ComplexSchur schur = complexSchur(balanced(transition));
    triangle = schur.t;
    to = schur.u.adjoint() * balancingUnits(transition).cwiseInverse().asDiagonal();
    from = balancingUnits(transition).asDiagonal() * schur.u;
  }
  Eigen::MatrixXcd triangle, to, from;
};

/// (z - F)^-1 of a transition F.
class Resolvent {
 public:
  explicit Resolvent(const MatrixXd& transition) {
    auto delayed = std::make_shared<const DelayedMatrix>(transition);
    if (isMostlyDelays(*delayed)) {
      delayed_ = std::move(delayed);
    } else {
      schur_ = std::make_shared<const SchurForm>(transition);
    }
  }

  /// Poles [1/s] of F over a period [s], and how closely the frequencies lie. `open`: F is of the
  /// loop that is opened.
  void addTo(LoopSpan& span, double period, int samples, bool open) const {
    if (!delayed_) {
      addPoles(schur_->triangle.diagonal(), period, samples, span.poles);
      return;
    }
    span.spacing = span.highest / (kPointsOfState * static_cast<double>(delayed_->states()));
    std::vector<Complex> narrow;
    for (const Complex& z : open ? delayed_->rootsWithoutDelays() : delayed_->roots()) {
      if (open || std::fabs(std::log(std::abs(z))) < span.spacing * period) {
        narrow.push_back(z);
      }
    }
    addPoles(Eigen::Map<const Eigen::VectorXcd>(narrow.data(), static_cast<Index>(narrow.size())),
             period, samples, span.poles);
  }
  bool isOfDelays() const { return delayed_ != nullptr; }

  /// What is found at a tap of a motion z^k that is added there: output (z - F)^-1 input + direct,
  /// one z a substitution.
  std::function<Eigen::MatrixXcd(const Complex&)> at(const LoopTap& tap) const {
    if (delayed_) {
      return [delayed = delayed_, tap](const Complex& z) -> Eigen::MatrixXcd {
        return tap.output * delayed->solve(z, tap.input) + tap.direct;
      };
    }
    Eigen::MatrixXcd input, output;
    if (schur_->triangle.size() > 0) {
      input = schur_->to * tap.input;
      output = tap.output * schur_->from;
    }
    return [schur = schur_, input, output, direct = tap.direct](const Complex& z) {
      Eigen::MatrixXcd shown = direct;
      const Eigen::MatrixXcd& t = schur->triangle;
      Eigen::VectorXcd rest;
      for (Index column = 0; column < input.cols(); ++column) {
        rest = input.col(column);
        for (Index k = t.rows() - 1; k >= 0; --k) {
          const Complex away = z - t(k, k);
          rest[k] *= std::conj(away) / std::norm(away);
          rest.head(k) += rest[k] * t.col(k).head(k);
        }
        shown.col(column).noalias() += output * rest;
      }
      return shown;
    };
  }

 private:
  std::shared_ptr<const SchurForm> schur_;
  std::shared_ptr<const DelayedMatrix> delayed_;  // instead, where most states are delays
};

struct Response : LoopResponse {
  /// sum of ln|p| over the unstable poles of the open loop; NaN: not known
  double unstable = 0.0;
  int samples = 1;  ///< in a period
};

std::vector<LoopPlace> placesOf(const LoopController& controller, std::size_t index,
                                LoopSide side) {
  const bool at_output = side == LoopSide::kOutputs;
  const auto& channels = at_output ? controller.acts_on : controller.measures;
  std::vector<LoopPlace> places;
  for (std::size_t i = 0; i < channels.size(); ++i) {
    places.push_back({index, static_cast<Index>(i), at_output});
  }
  return places;
}

std::vector<Response> responses(const LoopPlant& plant,
                                const std::vector<LoopController>& controllers,
                                std::size_t controller, LoopSide side) {
  const SampledLoop loop = sampledLoop(plant, controllers);
  const int samples = loop.samples.at(controller);
  const double step = loop.period / samples;
  const Resolvent resolvent(loop.transition);
  LoopSpan closed;
  closed.highest = kPi / step;
  closed.poles = {Complex(-1.0 / step, 0.0)};
  resolvent.addTo(closed, loop.period, samples, false);
  std::vector<Response> all;
  for (const LoopPlace& place : placesOf(controllers[controller], controller, side)) {
    Response& response = all.emplace_back();
    static_cast<LoopSpan&>(response) = closed;
    response.samples = samples;
    const SampledLoop open = sampledLoop(plant, opened(controllers, place));
    if (resolvent.isOfDelays()) {
      Resolvent(open.transition).addTo(response, loop.period, samples, true);
      response.unstable = kNaN;
    } else {
      const Eigen::VectorXcd poles = balancedEigenvalues(open.transition);
      addPoles(poles, loop.period, samples, response.poles);
      for (const Complex& z : poles) {
        response.unstable += std::fmax(0.0, std::log(std::abs(z)));
      }
    }
    response.open_loop = [shown = resolvent.at(loopTap(plant, controllers, {place})),
                          period = loop.period, step, samples](double w) {
      const Eigen::MatrixXcd lifted = shown(std::polar(1.0, w * period));
      Complex sensitivity = 0.0;
      for (Index to = 0; to < samples; ++to) {
        for (Index from = 0; from < samples; ++from) {
          sensitivity += std::polar(1.0 / samples, w * step * static_cast<double>(from - to)) *
                         lifted(to, from);
        }
      }
      return 1.0 / sensitivity - 1.0;
    };
  }
  return all;
}

}  // namespace

std::vector<LoopResponse> sampledResponses(const LoopPlant& plant,
                                           const std::vector<LoopController>& controllers,
                                           std::size_t controller, LoopSide side) {
  const std::vector<Response> all = responses(plant, controllers, controller, side);
  return {all.begin(), all.end()};
}

std::vector<SampledMargins> sampledMargins(const LoopPlant& plant,
                                           const std::vector<LoopController>& controllers,
                                           std::size_t controller, Verdict verdict, LoopSide side) {
  if (controller >= controllers.size()) {
    throw std::logic_error("sampled loop: there is no such controller");
  }
  std::vector<SampledMargins> all(placesOf(controllers[controller], controller, side).size());
  if (verdict != Verdict::kAsymptoticallyStable) {
    for (SampledMargins& margins : all) {
      margins.sensitivity_peak = kInfinity;
      margins.gain_reduction = margins.gain_margin = 1.0;
      margins.bode_error = kNaN;
    }
    return all;
  }
  const std::vector<Response> open = responses(plant, controllers, controller, side);
  for (std::size_t i = 0; i < all.size(); ++i) {
    SampledMargins& margins = all[i];
    static_cast<LoopMargins&>(margins) = loopMargins(open[i]);
    if (open[i].samples > 1) {
      margins.gain_margin = margins.gain_reduction = margins.phase_margin = kNaN;
      margins.phase_crossover = margins.delay_margin = margins.bode_error = kNaN;
      continue;
    }
    margins.bode_error =
        std::isnan(open[i].unstable)
            ? kNaN
            : std::fabs(logSensitivityIntegral(open[i]) / open[i].highest - open[i].unstable);
  }
  return all;
}

LoopMargins sampledMarginsAtOnce(const LoopPlant& plant,
                                 const std::vector<LoopController>& controllers, Verdict verdict) {
  LoopMargins margins;
  if (verdict != Verdict::kAsymptoticallyStable) {
    margins.sensitivity_peak = kInfinity;
    margins.gain_reduction = margins.gain_margin = 1.0;
    return margins;
  }
  const SampledLoop loop = sampledLoop(plant, controllers);
  if (std::any_of(loop.samples.begin(), loop.samples.end(), [](int n) { return n > 1; })) {
    margins.gain_margin = margins.gain_reduction = margins.phase_margin = kNaN;
    margins.phase_crossover = margins.delay_margin = kNaN;
    return margins;
  }
  const Resolvent resolvent(loop.transition);
  LoopMatrixResponse response;
  response.highest = kPi / loop.period;
  response.poles = {Complex(-1.0 / loop.period, 0.0)};
  resolvent.addTo(response, loop.period, 1, false);
  // The return ratios at sensors and at outputs have the same eigenvalues but for zeros.
  std::size_t sensors = 0, outputs = 0;
  for (const LoopController& controller : controllers) {
    sensors += controller.measures.size();
    outputs += controller.acts_on.size();
  }
  const LoopSide side = outputs < sensors ? LoopSide::kOutputs : LoopSide::kSensors;
  std::vector<LoopPlace> places;
  std::vector<LoopController> all_open = controllers;
  for (std::size_t i = 0; i < controllers.size(); ++i) {
    for (const LoopPlace& place : placesOf(controllers[i], i, side)) {
      places.push_back(place);
      all_open = opened(all_open, place);
    }
  }
  Resolvent(sampledLoop(plant, all_open).transition).addTo(response, loop.period, 1, true);
  response.open_loop = [shown = resolvent.at(loopTap(plant, controllers, places)),
                        period = loop.period](double w) -> Eigen::MatrixXcd {
    Eigen::MatrixXcd ratio = ComplexLu(shown(std::polar(1.0, w * period))).inverse();
    ratio.diagonal().array() -= 1.0;
    return ratio;
  };
  return simultaneousMargins(response);
}

LoopMargins leastMargins(const LoopMargins& at_once, const std::vector<SampledMargins>& margins) {
  LoopMargins all = margins.empty() ? at_once : margins.front();
  const auto take = [&all](const LoopMargins& one) {
    if (one.sensitivity_peak > all.sensitivity_peak) {
      all.sensitivity_peak = one.sensitivity_peak;
      all.peak_frequency = one.peak_frequency;
      all.zone = one.zone;
    }
    if (one.phase_margin < all.phase_margin) {
      all.phase_margin = one.phase_margin;
      all.phase_crossover = one.phase_crossover;
    }
    all.gain_margin = std::fmin(all.gain_margin, one.gain_margin);
    all.gain_reduction = std::fmax(all.gain_reduction, one.gain_reduction);
    all.delay_margin = std::fmin(all.delay_margin, one.delay_margin);
  };
  take(at_once);
  std::for_each(margins.begin(), margins.end(), take);
  return all;
}

}  // namespace whirl_twin
