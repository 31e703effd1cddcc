// Adapter from a model given by its energies to the interface of dynamics.h: its equations are
// derived (lagrangian.h), and its optional members are detected.
#pragma once

#include <Eigen/Core>
#include <array>
#include <memory>
#include <string>
#include <type_traits>
#include <vector>

#include "mechanics/dry_friction.h"
#include "mechanics/dynamics.h"
#include "mechanics/lagrangian.h"
#include "mechanics/linearization.h"
#include "mechanics/model_description.h"

namespace whirl_twin {

/// Detection of optional member functions of a model: if absent, the default applies.
template <class Model, class = void>
struct RotorTraits {
  static constexpr bool kRotor = false;
  static double phaseMark(const Model&) { return 0.0; }
};
template <class Model>
struct RotorTraits<Model, std::void_t<decltype(&Model::phaseMark)>> {
  static constexpr bool kRotor = true;
  static double phaseMark(const Model& m) { return m.phaseMark(); }
};

/// The former name of phaseMark(); a model that still defines it would not be recognized as a
/// rotor.
template <class Model, class = void>
struct HasUnbalanceAngle : std::false_type {};
template <class Model>
struct HasUnbalanceAngle<Model, std::void_t<decltype(&Model::unbalanceAngle)>> : std::true_type {};

template <class Model, class = void>
struct SpeedDependence {
  static bool of(const Model&) { return false; }
};
template <class Model>
struct SpeedDependence<Model, std::void_t<decltype(&Model::speedDependent)>> {
  static bool of(const Model& m) { return m.speedDependent(); }
};

template <class Model, class = void>
struct NaturalLength {
  static double of(const Model&) { return 1.0; }
};
template <class Model>
struct NaturalLength<Model, std::void_t<decltype(&Model::naturalLength)>> {
  static double of(const Model& m) { return m.naturalLength(); }
};

template <class Model, class = void>
struct HasAlternatingLoads : std::false_type {};
template <class Model>
struct HasAlternatingLoads<Model, std::void_t<decltype(&Model::atMeanLoad)>> : std::true_type {};

template <class Model, class = void>
struct LoadFrequencies {
  static std::vector<double> of(const Model&) { return {}; }
};
template <class Model>
struct LoadFrequencies<Model, std::void_t<decltype(&Model::loadFrequencies)>> {
  static std::vector<double> of(const Model& m) { return m.loadFrequencies(); }
};

/// An unbalance or a bow: balanced() is the model without.
template <class Model, class = void>
struct HasUnbalance : std::false_type {};
template <class Model>
struct HasUnbalance<Model, std::void_t<decltype(&Model::balanced)>> : std::true_type {};

template <class Model, class = void>
struct ModelInputs {
  static std::vector<InputInfo> of(const Model&) { return {}; }
};
template <class Model>
struct ModelInputs<Model, std::void_t<decltype(&Model::inputs)>> {
  static std::vector<InputInfo> of(const Model& model) {
    std::vector<InputInfo> all;
    for (const Input<Model::kDof>& input : model.inputs()) {
      all.push_back({input.name, input.unit,
                     Eigen::Map<const Eigen::VectorXd>(input.direction.data(), Model::kDof),
                     input.meaning});
    }
    return all;
  }
};

template <class Model, class = void>
struct HasReactions : std::false_type {};
template <class Model>
struct HasReactions<Model, std::void_t<decltype(&Model::reactions)>> : std::true_type {};

template <class Model, class = void>
struct HasConditions : std::false_type {};
template <class Model>
struct HasConditions<Model, std::void_t<decltype(&Model::conditions)>> : std::true_type {};

template <class Model, class = void>
struct HasSketch : std::false_type {};
template <class Model>
struct HasSketch<Model, std::void_t<decltype(&Model::sketch)>> : std::true_type {};

template <class Model, class = void>
struct SingularMass {
  static std::string of(const Model&) { return ""; }
};
template <class Model>
struct SingularMass<Model, std::void_t<decltype(&Model::singularMass)>> {
  static std::string of(const Model& m) { return m.singularMass(); }
};

template <class Model>
class LagrangianDynamics final : public Dynamics {
 public:
  static constexpr std::size_t n = Model::kDof;
  using Array = std::array<double, n>;
  static_assert(!HasUnbalanceAngle<Model>::value, "phaseMark() stands for unbalanceAngle() now");

  enum class Loads { kAll, kMean };

  explicit LagrangianDynamics(const Model& model, [[maybe_unused]] Loads loads = Loads::kAll)
      : model_(model) {
    if constexpr (HasAlternatingLoads<Model>::value) {
      if (loads == Loads::kAll) {
        at_mean_load_ = std::make_unique<LagrangianDynamics>(model.atMeanLoad(), Loads::kMean);
      }
    } else if constexpr (HasUnbalance<Model>::value) {
      if (loads == Loads::kAll) {
        at_mean_load_ = std::make_unique<LagrangianDynamics>(model.balanced(), Loads::kMean);
      }
    }
  }

  /// The energies, with their parameters.
  const Model& energyModel() const { return model_; }

  std::string model() const override { return Model::kName; }
  int dof() const override { return static_cast<int>(n); }
  std::vector<CoordinateInfo> coordinates() const override {
    std::vector<CoordinateInfo> all;
    for (const Coordinate& c : Model::kCoordinates) {
      all.push_back({c.name, c.unit, c.meaning});
    }
    return all;
  }
  std::vector<InputInfo> inputs() const override { return ModelInputs<Model>::of(model_); }
  bool linear() const override { return Model::kLinear; }
  bool hasShaft() const override { return Model::kHasShaft; }
  bool isRotor() const override { return RotorTraits<Model>::kRotor; }
  bool speedDependent() const override { return SpeedDependence<Model>::of(model_); }
  double phaseMark() const override { return RotorTraits<Model>::phaseMark(model_); }
  double naturalLength() const override { return NaturalLength<Model>::of(model_); }
  const Dynamics& atMeanLoad() const override { return at_mean_load_ ? *at_mean_load_ : *this; }
  std::vector<double> loadFrequencies() const override {
    return LoadFrequencies<Model>::of(model_);
  }

  Eigen::VectorXd acceleration(const Eigen::VectorXd& q, const Eigen::VectorXd& v,
                               const EvaluationPoint<double>& at) const override {
    const auto eom = equationsAt(model_, array(q), array(v), at);
    if constexpr (HasDryContacts<Model>::value) {
      DryState<n> state;
      return vector(withFriction(array(q), array(v), eom, state));
    }
    return vector(solveMass<double, n>(eom.mass, eom.force));
  }
  Eigen::VectorXd residualForce(const Eigen::VectorXd& q, const Eigen::VectorXd& v,
                                const EvaluationPoint<double>& at) const override {
    return vector(equationsAt(model_, array(q), array(v), at).force);
  }
  Eigen::VectorXd appliedForce(const Eigen::VectorXd& q, const Eigen::VectorXd& v,
                               const EvaluationPoint<double>& at) const override {
    return vector(whirl_twin::appliedForce(model_, array(q), array(v), at));
  }
  Eigen::MatrixXd massMatrix(const Eigen::VectorXd& q, const Eigen::VectorXd& v,
                             const EvaluationPoint<double>& at) const override {
    const auto packed = equationsAt(model_, array(q), array(v), at).mass;
    Eigen::MatrixXd mass(dof(), dof());
    for (int i = 0; i < dof(); ++i) {
      for (int j = 0; j <= i; ++j) {
        mass(i, j) = mass(j, i) = packed[static_cast<std::size_t>(i * (i + 1) / 2 + j)];
      }
    }
    return mass;
  }
  Eigen::VectorXd momenta(const Eigen::VectorXd& q, const Eigen::VectorXd& v,
                          const EvaluationPoint<double>& at) const override {
    return vector(whirl_twin::momenta(model_, array(q), array(v), at));
  }
  Energies energies(const Eigen::VectorXd& q, const Eigen::VectorXd& v,
                    const EvaluationPoint<double>& at) const override {
    return whirl_twin::energies(model_, array(q), array(v), at);
  }
  Linearization linearization(const Eigen::VectorXd& q, const Eigen::VectorXd& v,
                              const Eigen::VectorXd& a,
                              const EvaluationPoint<double>& at) const override {
    const FixedLinearization<n> l =
        whirl_twin::linearization(model_, array(q), array(v), array(a), at);
    return {l.mass, l.damping, l.gyroscopic, l.stiffness, l.circulatory};
  }
  std::vector<Reaction> reactions(
      [[maybe_unused]] const Eigen::VectorXd& q, [[maybe_unused]] const Eigen::VectorXd& v,
      [[maybe_unused]] const Eigen::VectorXd& a,
      [[maybe_unused]] const EvaluationPoint<double>& at) const override {
    if constexpr (HasReactions<Model>::value) {
      return model_.reactions(array(q), array(v), array(a), at);
    } else {
      return {};
    }
  }
  std::vector<Condition> conditions(
      [[maybe_unused]] const Eigen::VectorXd& q, [[maybe_unused]] const Eigen::VectorXd& v,
      [[maybe_unused]] const Eigen::VectorXd& a,
      [[maybe_unused]] const EvaluationPoint<double>& at) const override {
    if constexpr (HasConditions<Model>::value) {
      return model_.conditions(array(q), array(v), array(a), at);
    } else {
      return {};
    }
  }
  std::vector<DryHold> dryHolds([[maybe_unused]] const Eigen::VectorXd& q,
                                [[maybe_unused]] const Eigen::VectorXd& v,
                                [[maybe_unused]] const Eigen::VectorXd& applied,
                                [[maybe_unused]] const EvaluationPoint<double>& at) const override {
    std::vector<DryHold> holds;
    if constexpr (HasDryContacts<Model>::value) {
      auto eom = equationsAt(model_, array(q), array(v), at);
      for (std::size_t i = 0; i < n; ++i) {
        eom.force[i] += applied[static_cast<Eigen::Index>(i)];
      }
      DryState<n> state;
      withFriction(array(q), array(v), eom, state);
      const DryContacts<n> contacts = model_.dryContacts();
      for (std::size_t j = 0; j < contacts.count; ++j) {
        const DryContact<n>& contact = contacts.at[j];
        holds.push_back({contact.place, contact.unit, contact.level, contact.sliding(array(v)),
                         state.held[j], state.share[j]});
      }
    }
    return holds;
  }
  std::string singularMass() const override { return SingularMass<Model>::of(model_); }
  std::vector<Station> stations() const override {
    if constexpr (RotorTraits<Model>::kRotor) {
      return {{"disc", 0.0, Eigen::VectorXd::Unit(dof(), 0), Eigen::VectorXd::Unit(dof(), 1)}};
    } else {
      return {};
    }
  }
  Sketch sketch([[maybe_unused]] const Eigen::VectorXd& q,
                [[maybe_unused]] const EvaluationPoint<double>& at) const override {
    if constexpr (HasSketch<Model>::value) {
      return model_.sketch(array(q), at);
    } else {
      return {};
    }
  }

 private:
  /// q'' with the contacts that do not slide held as far as their friction goes.
  Array withFriction(const Array& q, const Array& v, EquationsOfMotion<double, n> eom,
                     DryState<n>& state) const {
    const DryContacts<n> contacts = HasDryContacts<Model>::of(model_);
    const auto friction = [&](const ContactNumbers& share) {
      return whirl_twin::dryFriction(model_, contacts, q, share);
    };
    const Array said = friction(contacts.computedShares(v));
    for (std::size_t i = 0; i < n; ++i) {
      eom.force[i] -= said[i];
    }
    state = dryState(eom.mass, eom.force, contacts, v, friction);
    return accelerationWithFriction(eom.mass, eom.force, contacts, friction, state);
  }
  static Array array(const Eigen::VectorXd& x) {
    Array r;
    for (std::size_t i = 0; i < n; ++i) {
      r[i] = x[static_cast<Eigen::Index>(i)];
    }
    return r;
  }
  static Eigen::VectorXd vector(const Array& x) {
    return Eigen::Map<const Eigen::Matrix<double, n, 1>>(x.data());
  }

  Model model_;
  std::unique_ptr<const LagrangianDynamics> at_mean_load_;  // none: nothing to leave out
};

}  // namespace whirl_twin
