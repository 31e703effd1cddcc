#include "models/batched_models.h"

#include <algorithm>
#include <array>
#include <cstddef>

#include "integration/batch_real.h"
#include "mechanics/dry_friction.h"
#include "mechanics/lagrangian.h"
#include "mechanics/lagrangian_dynamics.h"
#include "mechanics/oscillators/hinged_beam.h"
#include "mechanics/oscillators/rolling_disc.h"
#include "mechanics/oscillators/two_bar_linkage.h"
#include "mechanics/pendulums/cart_pendulum.h"
#include "mechanics/pendulums/double_pendulum.h"
#include "mechanics/pendulums/pendulum.h"
#include "mechanics/pendulums/rod_slider.h"
#include "mechanics/pendulums/rotating_pendulum.h"
#include "mechanics/pendulums/spinning_pendulum.h"
#include "mechanics/pendulums/sprung_inverted_pendulum.h"
#include "mechanics/rotors/governor.h"

namespace whirl_twin {

namespace {

/// All optional properties of a model, independent of cost.
template <class Model>
struct Whole {
  static constexpr bool fits(const Model&) { return true; }
  static WHIRL_TWIN_INLINE void apply(Model&) {}
};

/// A double pendulum without Coulomb friction, whose roots and quotients take a quarter of a step.
template <class Model>
struct WithoutFriction {
  static bool fits(const Model& model) { return model.coulomb1 == 0.0 && model.coulomb2 == 0.0; }
  static WHIRL_TWIN_INLINE void apply(Model& model) { model.coulomb1 = model.coulomb2 = 0.0; }
};

template <class Model, class Form>
class EquationsOf final : public BatchEquations {
 public:
  static constexpr std::size_t n = Model::kDof;

  explicit EquationsOf(const std::vector<const Model*>& members)
      : count_(members.size()), like_(*members.front()) {
    const std::size_t blocks = (count_ + kBlock - 1) / kBlock;
    parameters_.resize(blocks * kParameters * kBlock);
    for (std::size_t lane = 0; lane < blocks * kBlock; ++lane) {
      const Model& model = *members[std::min(lane, count_ - 1)];
      double* const block = parameters_.data() + lane / kBlock * kParameters * kBlock;
      for (std::size_t k = 0; k < kParameters; ++k) {
        block[k * kBlock + lane % kBlock] = model.*kAll[k].member;
      }
    }
    evaluate_ = widest();
  }

  std::size_t count() const noexcept override { return count_; }
  std::size_t dof() const noexcept override { return n; }
  bool hasShaft() const noexcept override { return Model::kHasShaft; }
  bool angular(std::size_t i) const noexcept override {
    return Model::kCoordinates[i].unit[0] == 'r';
  }
  void accelerate(std::size_t block, const double* q, const double* v,
                  const EvaluationPoint<double>& at, double* a) const noexcept override {
    evaluate_(like_, parameters_.data() + block * kParameters * kBlock, q, v, at, a);
  }

 private:
  static constexpr auto kAll = Model::parameters();
  static constexpr std::size_t kParameters = kAll.size();
  using Evaluate = void (*)(const Model&, const double*, const double*, const double*,
                            const EvaluationPoint<double>&, double*);

  /// A loop that compilers vectorize.
  static WHIRL_TWIN_INLINE void all(const Model& like, const double* __restrict parameters,
                                    const double* __restrict q, const double* __restrict v,
                                    const EvaluationPoint<double>& now, double* __restrict a) {
    const EvaluationPoint<double> at = now;
#pragma GCC ivdep
    for (std::size_t lane = 0; lane < kBlock; ++lane) {
      Model model = like;
      unrolled<kParameters>([&](auto k) WHIRL_TWIN_FLAT {
        constexpr auto member = Model::parameters()[k].member;
        model.*member = parameters[k * kBlock + lane];
      });
      Form::apply(model);
      std::array<BatchReal, n> place;
      std::array<BatchReal, n> rate;
      unrolled<n>([&](auto i) WHIRL_TWIN_FLAT {
        place[i] = q[i * kBlock + lane];
        rate[i] = v[i * kBlock + lane];
      });
      const auto eom = equationsOfMotion<Model, BatchReal, n>(model, place, rate, at);
      const auto found = solveMass<BatchReal, n>(eom.mass, eom.force);
      unrolled<n>([&](auto i) WHIRL_TWIN_FLAT { a[i * kBlock + lane] = found[i].x; });
    }
  }

  static void narrow(const Model& like, const double* parameters, const double* q, const double* v,
                     const EvaluationPoint<double>& at, double* a) {
    all(like, parameters, q, v, at, a);
  }
#if defined(__x86_64__) && !defined(__clang__)
  [[gnu::target("avx2,fma")]] static void wide(const Model& like, const double* parameters,
                                               const double* q, const double* v,
                                               const EvaluationPoint<double>& at, double* a) {
    all(like, parameters, q, v, at, a);
  }
  [[gnu::target("avx512f")]] static void widerStill(const Model& like, const double* parameters,
                                                    const double* q, const double* v,
                                                    const EvaluationPoint<double>& at, double* a) {
    all(like, parameters, q, v, at, a);
  }
  static Evaluate widest() {
    return __builtin_cpu_supports("avx512f") != 0                                      ? widerStill
           : __builtin_cpu_supports("avx2") != 0 && __builtin_cpu_supports("fma") != 0 ? wide
                                                                                       : narrow;
  }
#else
  static Evaluate widest() {
    return narrow;
  }
#endif

  std::size_t count_;
  Model like_;  ///< has what the surroundings give
  std::vector<double> parameters_;
  Evaluate evaluate_;
};

template <class Model, class Form = Whole<Model>>
std::unique_ptr<BatchEquations> ifAll(const std::vector<const Dynamics*>& members) {
  std::vector<const Model*> models;
  for (const Dynamics* member : members) {
    const auto* const dynamics = dynamic_cast<const LagrangianDynamics<Model>*>(member);
    // Where friction can hold, members have their events at different instants.
    if (dynamics == nullptr || !Form::fits(dynamics->energyModel()) ||
        HasDryContacts<Model>::of(dynamics->energyModel()).count > 0) {
      return nullptr;
    }
    models.push_back(&dynamics->energyModel());
  }
  return std::make_unique<EquationsOf<Model, Form>>(models);
}

}  // namespace

std::unique_ptr<BatchEquations> batchEquations(const std::vector<const Dynamics*>& members) {
  using Kind = std::unique_ptr<BatchEquations> (*)(const std::vector<const Dynamics*>&);
  constexpr Kind kKinds[] = {
      ifAll<DoublePendulum, WithoutFriction<DoublePendulum>>,
      ifAll<DoublePendulum>,
      ifAll<Pendulum>,
      ifAll<SpinningPendulum>,
      ifAll<RotatingPendulum>,
      ifAll<CartPendulum>,
      ifAll<RodSlider>,
      ifAll<SprungInvertedPendulum>,
      ifAll<Governor>,
      ifAll<RollingDisc>,
      ifAll<TwoBarLinkage>,
      ifAll<HingedBeam>,
  };
  for (const Kind kind : kKinds) {
    if (auto equations = kind(members)) {
      return equations;
    }
  }
  return nullptr;
}

}  // namespace whirl_twin
