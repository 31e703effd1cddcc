#include "analysis/sampled_margins.h"

#include <cmath>
#include <stdexcept>

#include "algebra/eigenvalues.h"
#include "analysis/balanced_matrix.h"

namespace whirl_twin {

namespace {

using Complex = std::complex<double>;
using Eigen::Index;
using Eigen::MatrixXd;

constexpr double kPi = 3.14159265358979323846;
constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNotANumber = std::numeric_limits<double>::quiet_NaN();
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

Eigen::VectorXcd eigenvaluesOf(const MatrixXd& transition) {
  return Eigen::EigenSolver<MatrixXd>(balanced(transition), false).eigenvalues();
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

/// What a tap is shown of a motion z^k that is added there: output (z - F)^-1 input + direct, with
/// F = U T U^H in Schur's form, so that one z takes a substitution.
class ShownByTap {
 public:
  ShownByTap(const MatrixXd& transition, const LoopTap& tap) : direct_(tap.direct) {
    if (transition.size() == 0) {
      return;
    }
    const Eigen::VectorXd units = balancingUnits(transition);
    const Eigen::ComplexSchur<MatrixXd> schur(balanced(transition));
    triangle_ = schur.matrixT();
    input_ = schur.matrixU().adjoint() * units.cwiseInverse().asDiagonal() * tap.input;
    output_ = tap.output * units.asDiagonal() * schur.matrixU();
  }

  Eigen::MatrixXcd at(const Complex& z) const {
    if (triangle_.size() == 0) {
      return direct_;
    }
    Eigen::MatrixXcd shifted = -triangle_;
    shifted.diagonal().array() += z;
    return direct_ + output_ * shifted.triangularView<Eigen::Upper>().solve(input_);
  }

 private:
  Eigen::MatrixXcd direct_, triangle_, input_, output_;
};

}  // namespace

LoopResponse sampledResponse(const LoopPlant& plant, const std::vector<LoopController>& controllers,
                             std::size_t controller, Index measure) {
  const SampledLoop loop = sampledLoop(plant, controllers);
  const LoopTap tap = loopTap(plant, controllers, controller, measure);
  const int samples = loop.samples[controller];
  const double step = loop.period / samples;
  LoopResponse response;
  response.highest = kPi / step;
  response.poles.emplace_back(-1.0 / step, 0.0);
  addPoles(eigenvaluesOf(loop.transition), loop.period, samples, response.poles);
  const SampledLoop open = sampledLoop(plant, opened(controllers, controller, measure));
  addPoles(eigenvaluesOf(open.transition), loop.period, samples, response.poles);
  response.open_loop = [shown = ShownByTap(loop.transition, tap), period = loop.period, step,
                        samples](double w) {
    const Eigen::MatrixXcd lifted = shown.at(std::polar(1.0, w * period));
    Complex sensitivity = 0.0;
    for (Index i = 0; i < samples; ++i) {
      for (Index j = 0; j < samples; ++j) {
        sensitivity +=
            std::polar(1.0 / samples, w * step * static_cast<double>(j - i)) * lifted(i, j);
      }
    }
    return 1.0 / sensitivity - 1.0;
  };
  return response;
}

std::vector<SampledMargins> sampledMargins(const LoopPlant& plant,
                                           const std::vector<LoopController>& controllers,
                                           std::size_t controller, Verdict verdict) {
  if (controller >= controllers.size()) {
    throw std::logic_error("sampled loop: there is no such controller");
  }
  std::vector<SampledMargins> all(controllers[controller].measures.size());
  for (std::size_t i = 0; i < all.size(); ++i) {
    SampledMargins& margins = all[i];
    if (verdict != Verdict::kAsymptoticallyStable) {
      margins.sensitivity_peak = kInfinity;
      margins.gain_reduction = margins.gain_margin = 1.0;
      margins.bode_error = kNotANumber;
      continue;
    }
    const auto measure = static_cast<Index>(i);
    const LoopResponse response = sampledResponse(plant, controllers, controller, measure);
    static_cast<LoopMargins&>(margins) = loopMargins(response);
    const SampledLoop open = sampledLoop(plant, opened(controllers, controller, measure));
    if (open.samples[controller] > 1) {
      margins.gain_margin = margins.gain_reduction = margins.phase_margin = kNotANumber;
      margins.phase_crossover = margins.delay_margin = margins.bode_error = kNotANumber;
      continue;
    }
    double unstable = 0.0;
    for (const Complex& z : eigenvaluesOf(open.transition)) {
      unstable += std::fmax(0.0, std::log(std::abs(z)));
    }
    margins.bode_error = std::fabs(logSensitivityIntegral(response) / response.highest - unstable);
  }
  return all;
}

}  // namespace whirl_twin
