#include "scene/driven_dynamics.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "algebra/dense.h"
#include "mechanics/held_inputs.h"
#include "mechanics/locally_forced_rotor.h"
#include "scene/input_reader.h"

namespace whirl_twin {

namespace {

using Eigen::VectorXd;

bool alternates(const InputSignal& signal) {
  return signal.kind == InputSignal::Kind::kHarmonic && signal.amplitude != 0.0 &&
         signal.frequency != 0.0;
}

class DrivenDynamics final : public Dynamics {
 public:
  DrivenDynamics(std::shared_ptr<const Dynamics> dynamics, std::vector<InputSignal> signals)
      : system_(std::move(dynamics)), signals_(std::move(signals)) {
    const std::vector<InputInfo> infos = system_->inputs();
    for (std::size_t i = 0; i < infos.size(); ++i) {
      if (alternates(signals_[i])) {
        acting_.push_back({static_cast<Eigen::Index>(i), infos[i].direction});
      }
    }
  }

  std::string model() const override { return system_->model(); }
  int dof() const override { return system_->dof(); }
  std::vector<CoordinateInfo> coordinates() const override { return system_->coordinates(); }
  std::vector<InputInfo> inputs() const override { return system_->inputs(); }
  bool linear() const override { return false; }
  bool hasShaft() const override { return system_->hasShaft(); }
  bool isRotor() const override { return system_->isRotor(); }
  bool speedDependent() const override { return system_->speedDependent(); }
  double phaseMark() const override { return system_->phaseMark(); }
  double naturalLength() const override { return system_->naturalLength(); }
  const Dynamics& atMeanLoad() const override { return system_->atMeanLoad(); }
  std::vector<double> loadFrequencies() const override {
    std::vector<double> all = system_->loadFrequencies();
    for (const InputSignal& signal : signals_) {
      if (alternates(signal)) {
        all.push_back(signal.frequency);
      }
    }
    return all;
  }

  VectorXd acceleration(const VectorXd& q, const VectorXd& v,
                        const EvaluationPoint<double>& at) const override {
    const VectorXd force = pushed(q, at);
    const Eigen::MatrixXd mass = system_->massMatrix(q, v, at);
    return system_->acceleration(q, v, at) +
           (mass.size() == 1 ? VectorXd(force / mass(0, 0)) : VectorXd(Ldlt(mass).solve(force)));
  }
  VectorXd residualForce(const VectorXd& q, const VectorXd& v,
                         const EvaluationPoint<double>& at) const override {
    return system_->residualForce(q, v, at) + pushed(q, at);
  }
  VectorXd appliedForce(const VectorXd& q, const VectorXd& v,
                        const EvaluationPoint<double>& at) const override {
    return system_->appliedForce(q, v, at) + pushed(q, at);
  }
  Eigen::MatrixXd massMatrix(const VectorXd& q, const VectorXd& v,
                             const EvaluationPoint<double>& at) const override {
    return system_->massMatrix(q, v, at);
  }
  VectorXd momenta(const VectorXd& q, const VectorXd& v,
                   const EvaluationPoint<double>& at) const override {
    return system_->momenta(q, v, at);
  }
  Energies energies(const VectorXd& q, const VectorXd& v,
                    const EvaluationPoint<double>& at) const override {
    return system_->energies(q, v, at);
  }
  Linearization linearization(const VectorXd& q, const VectorXd& v, const VectorXd& a,
                              const EvaluationPoint<double>& at) const override {
    Linearization l = system_->linearization(q, v, a, at);
    if (!by_place_) {
      return l;
    }
    const Eigen::MatrixXd stiffness = held(q, at).stiffness;
    l.stiffness += 0.5 * (stiffness + stiffness.transpose());
    l.circulatory += 0.5 * (stiffness - stiffness.transpose());
    return l;
  }
  std::vector<Reaction> reactions(const VectorXd& q, const VectorXd& v, const VectorXd& a,
                                  const EvaluationPoint<double>& at) const override {
    return system_->reactions(q, v, a, at);
  }
  std::vector<Condition> conditions(const VectorXd& q, const VectorXd& v, const VectorXd& a,
                                    const EvaluationPoint<double>& at) const override {
    return system_->conditions(q, v, a, at);
  }
  std::vector<DryHold> dryHolds(const VectorXd& q, const VectorXd& v, const VectorXd& applied,
                                const EvaluationPoint<double>& at) const override {
    return system_->dryHolds(q, v, applied + pushed(q, at), at);
  }
  std::string singularMass() const override { return system_->singularMass(); }
  std::vector<Station> stations() const override { return system_->stations(); }
  std::vector<Station> casing() const override { return system_->casing(); }
  Sketch sketch(const VectorXd& q, const EvaluationPoint<double>& at) const override {
    return system_->sketch(q, at);
  }

 private:
  struct Acting {
    Eigen::Index input;
    VectorXd direction;
  };

  double value(const Acting& acting, double time) const {
    const InputSignal& signal = signals_[static_cast<std::size_t>(acting.input)];
    return signal.amplitude * std::cos(signal.frequency * time + signal.phase);
  }
  HeldInputs held(const VectorXd& q, const EvaluationPoint<double>& at) const {
    VectorXd values = VectorXd::Zero(static_cast<Eigen::Index>(signals_.size()));
    for (const Acting& acting : acting_) {
      values[acting.input] = value(acting, at.time);
    }
    return heldInputs(*system_, q, values);
  }
  /// The generalized force of the inputs.
  VectorXd pushed(const VectorXd& q, const EvaluationPoint<double>& at) const {
    if (by_place_) {
      return held(q, at).force;
    }
    VectorXd force = VectorXd::Zero(q.size());
    for (const Acting& acting : acting_) {
      force += value(acting, at.time) * acting.direction;
    }
    return force;
  }

  std::shared_ptr<const Dynamics> system_;
  std::vector<InputSignal> signals_;  // of all inputs
  std::vector<Acting> acting_;
  /// The input forces depend on the coordinates, as those of magnet currents do.
  bool by_place_ = dynamic_cast<const LocallyForcedRotor*>(system_.get()) != nullptr;
};

}  // namespace

std::shared_ptr<const Dynamics> judgedDynamics(std::shared_ptr<const Dynamics> dynamics,
                                               const SystemSpec& spec) {
  if (dynamics->linear() || spec.inputs.empty()) {
    return dynamics;
  }
  std::vector<InputSignal> signals = signalsOf(dynamics->inputs(), spec.inputs);
  if (std::none_of(signals.begin(), signals.end(), alternates)) {
    return dynamics;
  }
  return std::make_shared<DrivenDynamics>(std::move(dynamics), std::move(signals));
}

}  // namespace whirl_twin
