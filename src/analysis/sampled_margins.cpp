#include "analysis/sampled_margins.h"

#include <cmath>
#include <memory>
#include <stdexcept>
#include <utility>

#include "algebra/constants.h"
#include "algebra/dense.h"
#include "analysis/balanced_matrix.h"

namespace whirl_twin {

namespace {

using Complex = std::complex<double>;
using Eigen::Index;
using Eigen::MatrixXd;

/// Eigenvalues below it are those of delays, which have no frequency.
constexpr double kGoneInASample = 1e-6;

/// The loop with one measure of a controller cut.
std::vector<LoopController> opened(std::vector<LoopController> controllers, std::size_t controller,
                                   Index measure) {
  DiscreteStateSpace& law = controllers.at(controller).law;
  law.b.col(measure).setZero();
  law.d.col(measure).setZero();
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

/// What a tap is shown of a motion z^k that is added there: output (z - F)^-1 input + direct, one z
/// a substitution.
class ShownByTap {
 public:
  ShownByTap(std::shared_ptr<const SchurForm> schur, const LoopTap& tap)
      : schur_(std::move(schur)), direct_(tap.direct) {
    if (schur_->triangle.size() > 0) {
      input_ = schur_->to * tap.input;
      output_ = tap.output * schur_->from;
    }
  }

  Eigen::MatrixXcd at(const Complex& z) const {
    Eigen::MatrixXcd shown = direct_;
    const Eigen::MatrixXcd& t = schur_->triangle;
    Eigen::VectorXcd rest;
    for (Index column = 0; column < input_.cols(); ++column) {
      rest = input_.col(column);
      for (Index k = t.rows() - 1; k >= 0; --k) {
        const Complex away = z - t(k, k);
        rest[k] *= std::conj(away) / std::norm(away);
        rest.head(k) += rest[k] * t.col(k).head(k);
      }
      shown.col(column).noalias() += output_ * rest;
    }
    return shown;
  }

 private:
  std::shared_ptr<const SchurForm> schur_;
  Eigen::MatrixXcd direct_, input_, output_;
};

struct Response : LoopResponse {
  /// sum of ln|p| over the unstable poles of the open loop
  double unstable = 0.0;
  int samples = 1;  ///< in a period
};

std::vector<Response> responses(const LoopPlant& plant,
                                const std::vector<LoopController>& controllers,
                                std::size_t controller) {
  const SampledLoop loop = sampledLoop(plant, controllers);
  const int samples = loop.samples.at(controller);
  const double step = loop.period / samples;
  const auto schur = std::make_shared<const SchurForm>(loop.transition);
  std::vector<Complex> closed{Complex(-1.0 / step, 0.0)};
  addPoles(schur->triangle.diagonal(), loop.period, samples, closed);
  std::vector<Response> all(controllers[controller].measures.size());
  for (std::size_t i = 0; i < all.size(); ++i) {
    const auto measure = static_cast<Index>(i);
    Response& response = all[i];
    response.samples = samples;
    response.highest = kPi / step;
    response.poles = closed;
    const SampledLoop open = sampledLoop(plant, opened(controllers, controller, measure));
    const Eigen::VectorXcd poles = balancedEigenvalues(open.transition);
    addPoles(poles, loop.period, samples, response.poles);
    for (const Complex& z : poles) {
      response.unstable += std::fmax(0.0, std::log(std::abs(z)));
    }
    const LoopTap tap = loopTap(plant, controllers, controller, measure);
    response.open_loop = [shown = ShownByTap(schur, tap), period = loop.period, step,
                          samples](double w) {
      const Eigen::MatrixXcd lifted = shown.at(std::polar(1.0, w * period));
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
                                           std::size_t controller) {
  const std::vector<Response> all = responses(plant, controllers, controller);
  return {all.begin(), all.end()};
}

std::vector<SampledMargins> sampledMargins(const LoopPlant& plant,
                                           const std::vector<LoopController>& controllers,
                                           std::size_t controller, Verdict verdict) {
  if (controller >= controllers.size()) {
    throw std::logic_error("sampled loop: there is no such controller");
  }
  std::vector<SampledMargins> all(controllers[controller].measures.size());
  if (verdict != Verdict::kAsymptoticallyStable) {
    for (SampledMargins& margins : all) {
      margins.sensitivity_peak = kInfinity;
      margins.gain_reduction = margins.gain_margin = 1.0;
      margins.bode_error = kNaN;
    }
    return all;
  }
  const std::vector<Response> open = responses(plant, controllers, controller);
  for (std::size_t i = 0; i < all.size(); ++i) {
    SampledMargins& margins = all[i];
    static_cast<LoopMargins&>(margins) = loopMargins(open[i]);
    if (open[i].samples > 1) {
      margins.gain_margin = margins.gain_reduction = margins.phase_margin = kNaN;
      margins.phase_crossover = margins.delay_margin = margins.bode_error = kNaN;
      continue;
    }
    margins.bode_error =
        std::fabs(logSensitivityIntegral(open[i]) / open[i].highest - open[i].unstable);
  }
  return all;
}

LoopMargins leastMargins(const std::vector<SampledMargins>& margins) {
  LoopMargins all = margins.front();
  for (const LoopMargins& one : margins) {
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
  }
  return all;
}

}  // namespace whirl_twin
