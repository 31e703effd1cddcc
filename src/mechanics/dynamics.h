// A model behind one interface, for everything that is not a step: analysis, display, checking.
// (A step never goes through here: it is composed with its model at compile time.)
#pragma once

#include <Eigen/Core>
#include <memory>
#include <string>
#include <type_traits>
#include <vector>

#include "mechanics/lagrangian.h"
#include "mechanics/model_description.h"

namespace whirl_twin {

/// M q'' + (C + G) q' + (K + N) q = 0 for small deviations; C, K symmetric, G, N skew. [n x n]
struct Linearization {
  Eigen::MatrixXd mass, damping, gyroscopic, stiffness, circulatory;
};

/// A model with its parameters. Vectors are of size dof(), in the order of coordinates().
class Dynamics {
 public:
  virtual ~Dynamics() = default;

  virtual std::string model() const = 0;
  virtual int dof() const = 0;
  virtual std::vector<Coordinate> coordinates() const = 0;
  virtual bool linear() const = 0;            ///< equations linear in q and v
  virtual bool hasShaft() const = 0;          ///< the motion of a shaft enters
  virtual bool speedDependent() const = 0;    ///< the matrices of a linear model change with speed
  virtual double unbalanceAngle() const = 0;  ///< [rad], of a rotor's unbalance from the mark
  virtual double naturalLength() const = 0;   ///< [m], scale of the sliding coordinates
  /// The same system without the loads that alternate: its equilibria are those at rest.
  virtual const Dynamics& atMeanLoad() const = 0;

  virtual Eigen::VectorXd acceleration(const Eigen::VectorXd& q, const Eigen::VectorXd& v,
                                       const Moment<double>& at) const = 0;
  /// The generalized force that is left when the system is held: zero at an equilibrium.
  virtual Eigen::VectorXd holdingForce(const Eigen::VectorXd& q,
                                       const Moment<double>& at) const = 0;
  virtual Energies energies(const Eigen::VectorXd& q, const Eigen::VectorXd& v,
                            const Moment<double>& at) const = 0;
  virtual Linearization linearization(const Eigen::VectorXd& q, const Eigen::VectorXd& v,
                                      const Eigen::VectorXd& a, const Moment<double>& at) const = 0;
};

/// Does the model have a member function or not: absent means the plain answer.
template <class Model, class = void>
struct RotorTraits {
  static constexpr bool kRotor = false;
  static bool speedDependent(const Model&) { return false; }
  static double unbalanceAngle(const Model&) { return 0.0; }
};
template <class Model>
struct RotorTraits<Model, std::void_t<decltype(&Model::unbalanceAngle)>> {
  static constexpr bool kRotor = true;
  static bool speedDependent(const Model& m) { return m.speedDependent(); }
  static double unbalanceAngle(const Model& m) { return m.unbalanceAngle(); }
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

template <class Model>
class LagrangianDynamics final : public Dynamics {
 public:
  static constexpr std::size_t n = Model::kDof;
  using Array = std::array<double, n>;

  enum class Loads { kAll, kMean };

  explicit LagrangianDynamics(const Model& model, [[maybe_unused]] Loads loads = Loads::kAll)
      : model_(model) {
    if constexpr (HasAlternatingLoads<Model>::value) {
      if (loads == Loads::kAll) {
        at_mean_load_ = std::make_unique<LagrangianDynamics>(model.atMeanLoad(), Loads::kMean);
      }
    }
  }

  std::string model() const override { return Model::kName; }
  int dof() const override { return static_cast<int>(n); }
  std::vector<Coordinate> coordinates() const override {
    return {Model::kCoordinates.begin(), Model::kCoordinates.end()};
  }
  bool linear() const override { return Model::kLinear; }
  bool hasShaft() const override { return Model::kHasShaft; }
  bool speedDependent() const override { return RotorTraits<Model>::speedDependent(model_); }
  double unbalanceAngle() const override { return RotorTraits<Model>::unbalanceAngle(model_); }
  double naturalLength() const override { return NaturalLength<Model>::of(model_); }
  const Dynamics& atMeanLoad() const override { return at_mean_load_ ? *at_mean_load_ : *this; }

  Eigen::VectorXd acceleration(const Eigen::VectorXd& q, const Eigen::VectorXd& v,
                               const Moment<double>& at) const override {
    return vector(derivative(model_, array(q), array(v), at).acceleration);
  }
  Eigen::VectorXd holdingForce(const Eigen::VectorXd& q, const Moment<double>& at) const override {
    return vector(equationsOfMotion(model_, array(q), Array{}, at).force);
  }
  Energies energies(const Eigen::VectorXd& q, const Eigen::VectorXd& v,
                    const Moment<double>& at) const override {
    return whirl_twin::energies(model_, array(q), array(v), at);
  }
  Linearization linearization(const Eigen::VectorXd& q, const Eigen::VectorXd& v,
                              const Eigen::VectorXd& a, const Moment<double>& at) const override {
    const FixedLinearization<n> l =
        whirl_twin::linearization(model_, array(q), array(v), array(a), at);
    return {l.mass, l.damping, l.gyroscopic, l.stiffness, l.circulatory};
  }

 private:
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
  std::unique_ptr<const LagrangianDynamics> at_mean_load_;  // none: it has no alternating loads
};

}  // namespace whirl_twin
