#include "twin/ensemble_members.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <limits>
#include <optional>
#include <utility>

#include "algebra/constants.h"
#include "integration/exponential.h"
#include "integration/finite.h"
#include "integration/step_error_sum.h"
#include "twin/batched_members.h"
#include "twin/record.h"

namespace whirl_twin {

namespace {

class SideBySide final : public EnsembleSteps {
 public:
  SideBySide(const std::vector<IsotropicRotor>& rotors, const Drive& drive, double step)
      : drive_(drive),
        step_(step),
        rotors_(rotors, step, highestSpeed(drive)),
        sampled_(sampledMembers(rotors.size())),
        halves_(of(sampled_, rotors), step, highestSpeed(drive), 2),
        errors_(sampled_.size(), StepErrorSum(kLinearErrorEvery)),
        due_(sampled_.size()),
        start_rates_(sampled_.size()) {}
  int parts() const { return rotors_.parts(); }

  const char* description() const override { return "side by side in vectors"; }
  std::pair<double, double> speeds() const override {
    return {-rotors_.limitSpeed(), rotors_.limitSpeed()};
  }
  void reset() noexcept override {
    rotors_.reset();
    for (StepErrorSum& errors : errors_) {
      errors.restart();
    }
  }
  void exchange(StateImage& image) noexcept override { image(rotors_, errors_); }
  void step(double) noexcept override {
    bool any = false;
    for (std::size_t k = 0; k < sampled_.size(); ++k) {
      due_[k] = errors_[k].countStep() ? 1 : 0;
      any = any || due_[k] != 0;
    }
    for (std::size_t k = 0; any && k < sampled_.size(); ++k) {
      halves_.put(k, rotors_, sampled_[k]);
      start_rates_[k] = rotors_.rate(sampled_[k]);
    }
    rotors_.step(drive_);
    if (any) {
      estimateErrors();
    }
  }
  double errorSum() const noexcept override {
    double largest = 0.0;
    for (const StepErrorSum& errors : errors_) {
      largest = std::fmax(largest, errors.sum());
    }
    return largest;
  }
  void write(double* values, double* peaks) const noexcept override {
    for (std::size_t i = 0; i < rotors_.count(); ++i) {
      const double radius = std::sqrt(std::norm(rotors_.position(i)));
      values[i] = isFinite(radius) ? radius : kNaN;
      peaks[i] = isFinite(radius) ? rotors_.peak(i) : kNaN;
    }
  }

 private:
  static std::vector<IsotropicRotor> of(const std::vector<std::size_t>& members,
                                        const std::vector<IsotropicRotor>& rotors) {
    std::vector<IsotropicRotor> chosen;
    for (const std::size_t member : members) {
      chosen.push_back(rotors[member]);
    }
    return chosen;
  }
  /// Repeats the last step as two half steps.
  void estimateErrors() noexcept {
    halves_.step(drive_);
    for (std::size_t k = 0; k < sampled_.size(); ++k) {
      const std::complex<double> q = rotors_.position(sampled_[k]);
      const std::complex<double> v = rotors_.rate(sampled_[k]);
      const std::complex<double> finer_q = halves_.position(k);
      const std::complex<double> finer_v = halves_.rate(k);
      const auto plane = [](const std::complex<double>& z) {
        return std::array<double, 2>{z.real(), z.imag()};
      };
      if (due_[k] == 0) {
        continue;
      }
      if (isFinite(std::norm(q))) {
        errors_[k].add(2, step_, plane(start_rates_[k]), plane(q), plane(v), plane(finer_q),
                       plane(finer_v), [](std::size_t) { return false; });
      } else {
        errors_[k].passOver();
      }
    }
  }

  const Drive& drive_;
  double step_;  // [s]
  IsotropicRotors rotors_;
  std::vector<std::size_t> sampled_;               // members
  IsotropicRotors halves_;                         // of these, with half the step
  std::vector<StepErrorSum> errors_;               // likewise
  std::vector<char> due_;                          // likewise: is this step checked?
  std::vector<std::complex<double>> start_rates_;  // [m/s], likewise: before a checked step
};

class OneByOne final : public EnsembleSteps {
 public:
  OneByOne(const std::vector<EnsembleMember>& members, const std::string& integrator,
           const StepContext& excitation, double step) {
    for (const EnsembleMember& m : members) {
      Member member;
      member.spec = m.spec;
      member.system = m.setup.system(integrator, excitation, step, m.spec.substeps);
      member.rest = m.rest;
      if (m.setup.dynamics->isRotor()) {
        member.station = m.setup.dynamics->stations().front();
      }
      state_.resize(std::max(state_.size(), SystemView::motionSize(member.system->dof())));
      members_.push_back(std::move(member));
    }
    const Dynamics& dynamics = *members.front().setup.dynamics;
    if (dynamics.linear() && dynamics.hasShaft() && dynamics.speedDependent()) {
      speeds_ = excitation.drive.speedRange();
    }
    quantities_ = members_.front().station ? 1 : members_.front().system->dof();
    values_.resize(members_.size() * quantities_);
    peaks_.resize(values_.size());
  }

  const char* description() const override { return "one by one"; }
  std::pair<double, double> speeds() const override { return speeds_; }
  void reset() noexcept override {
    for (Member& member : members_) {
      member.system->set(member.spec.q.data(), member.spec.v.data());
      member.status = StepStatus::kOk;
    }
    std::fill(peaks_.begin(), peaks_.end(), 0.0);
    look();
  }
  void exchange(StateImage& image) noexcept override { image(members_, values_, peaks_); }
  void step(double time) noexcept override {
    for (Member& member : members_) {
      if (member.status == StepStatus::kOk) {
        member.status = member.system->step(time);
      }
    }
    look();
  }
  void write(double* values, double* peaks) const noexcept override {
    std::copy(values_.begin(), values_.end(), values);
    std::copy(peaks_.begin(), peaks_.end(), peaks);
  }
  double errorSum() const noexcept override {
    double largest = 0.0;
    const std::size_t apart = (members_.size() + kMaxSampled - 1) / kMaxSampled;
    for (std::size_t i = 0; i < members_.size(); i += apart) {
      if (members_[i].status == StepStatus::kOk) {
        largest = std::fmax(largest, members_[i].system->errorSum());
      }
    }
    return largest;
  }

 private:
  struct Member {
    SystemSpec spec;
    std::unique_ptr<Stepper> system;
    std::optional<Station> station;  // of a rotor
    Eigen::Vector2d rest{0.0, 0.0};  // [m]
    StepStatus status = StepStatus::kOk;

    void exchange(StateImage& image) noexcept {
      image(status);
      image.requireWithin(status, StepStatus::kOk, StepStatus::kNoGap);
      system->exchange(image);
    }
  };

  void look() noexcept {
    for (std::size_t i = 0; i < members_.size(); ++i) {
      const Member& member = members_[i];
      double* const values = values_.data() + i * quantities_;
      double* const peaks = peaks_.data() + i * quantities_;
      if (member.status != StepStatus::kOk) {
        std::fill_n(values, quantities_, kNaN);
        std::fill_n(peaks, quantities_, kNaN);
        continue;
      }
      member.system->write(state_.data());
      if (member.station) {
        const Eigen::Map<const Eigen::VectorXd> q(state_.data(), member.station->along_x.size());
        values[0] = std::hypot(member.station->along_x.dot(q) - member.rest.x(),
                               member.station->along_y.dot(q) - member.rest.y());
      } else {
        std::copy_n(state_.data(), quantities_, values);
      }
      for (std::size_t k = 0; k < quantities_; ++k) {
        peaks[k] = std::fmax(peaks[k], std::fabs(values[k]));
      }
    }
  }

  std::vector<Member> members_;
  std::pair<double, double> speeds_{-std::numeric_limits<double>::infinity(),
                                    std::numeric_limits<double>::infinity()};
  std::size_t quantities_ = 0;
  std::vector<double> values_;
  std::vector<double> peaks_;
  std::vector<double> state_;
};

}  // namespace

std::optional<IsotropicRotor> isotropicRotor(const Dynamics& dynamics, const SystemSpec& spec) {
  if (!dynamics.isRotor() || !dynamics.linear() || dynamics.dof() != 2) {
    return std::nullopt;
  }
  const Station seen = dynamics.stations().front();
  if (seen.along_x != Eigen::Vector2d::UnitX() || seen.along_y != Eigen::Vector2d::UnitY()) {
    return std::nullopt;
  }
  const LinearRotor rotor = dynamics.linearRotor();
  const Linearization l = rotor.matrices(0.0);
  const auto isotropic = [](const Eigen::MatrixXd& m) {
    return m(0, 0) == m(1, 1) && m(0, 1) == 0.0 && m(1, 0) == 0.0;
  };
  if (rotor.speed_dependent || !(l.stiffness(0, 0) > 0.0) || !isotropic(l.mass) ||
      !isotropic(l.damping) || !isotropic(l.stiffness) || !l.gyroscopic.isZero(0.0) ||
      !l.circulatory.isZero(0.0)) {
    return std::nullopt;
  }
  const double mass = l.mass(0, 0);
  IsotropicRotor found;
  found.damping = l.damping(0, 0) / mass;
  found.stiffness = l.stiffness(0, 0) / mass;
  found.load = std::complex<double>(rotor.load[0], rotor.load[1]) / mass;
  for (const ShaftForce& force : rotor.forces) {
    // Re[F e^(i theta)] along x and Re[-i F e^(i theta)] along y: a circularly rotating force.
    const std::complex<double> amplitude = force.amplitude[0];
    const std::complex<double> aside = std::complex<double>(0.0, -1.0) * amplitude;
    // The synchronous force is computed together with the load and has its rounding errors.
    const double rounding = 1.0e-12 * std::abs(amplitude) + 1.0e-15 * rotor.load.norm();
    if (force.harmonic != 1 || std::abs(force.amplitude[1] - aside) > rounding) {
      return std::nullopt;
    }
    (force.inertial ? found.eccentricity : found.bow_force) += amplitude / mass;
  }
  found.start = {spec.q[0], spec.q[1]};
  found.start_rate = {spec.v[0], spec.v[1]};
  return found;
}

double highestSpeed(const Drive& drive) {
  const auto [low, high] = drive.speedRange();
  return std::fmax(std::fabs(low), std::fabs(high));
}

std::vector<std::size_t> sampledMembers(std::size_t count) {
  const std::size_t sampled = std::min(count, kMaxSampled);
  std::vector<std::size_t> members;
  for (std::size_t k = 0; k < sampled; ++k) {
    members.push_back(k * count / sampled);
  }
  return members;
}

std::unique_ptr<EnsembleSteps> ensembleSteps(const std::vector<EnsembleMember>& members,
                                             const std::string& integrator,
                                             const StepContext& excitation, double step) {
  // Equivalent to the exact step within some 1e-12; with very many sub-steps, one by one is faster.
  if (integrator == Exponential<1>::kName && excitation.inputs == nullptr) {
    std::vector<IsotropicRotor> rotors;
    for (const EnsembleMember& member : members) {
      if (auto rotor = isotropicRotor(*member.setup.dynamics, member.spec)) {
        // About its equilibrium, an isotropic rotor whirls as without a load.
        rotor->start -= rotor->load / rotor->stiffness;
        rotor->load = 0.0;
        rotors.push_back(*rotor);
      }
    }
    if (rotors.size() == members.size()) {
      auto together = std::make_unique<SideBySide>(rotors, excitation.drive, step);
      if (together->parts() <= kMaxPartsSideBySide) {
        return together;
      }
    }
  }
  if (auto together = batchedMembers(members, integrator, excitation, step)) {
    return together;
  }
  return std::make_unique<OneByOne>(members, integrator, excitation, step);
}

}  // namespace whirl_twin
