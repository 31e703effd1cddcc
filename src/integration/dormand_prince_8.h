// The method of order 8 of Dormand and Prince in the form DOP853 (Hairer, Norsett & Wanner, Solving
// Ordinary Differential Equations I, 2nd ed., II.5 and its appendix) with a fixed step, on
// (q, v, work).
//
// Order 8, explicit, twelve evaluations. Not symplectic: it loses energy of order h^9 a step, which
// is below rounding long before a swing has a hundred steps. Treats damping and gyroscopic terms
// like any other. Stable for h |lambda| < 5.9 near the imaginary axis; nothing warns of a stiff
// system but the energy audit and, in the end, a state that is not finite.
#pragma once

#include "integration/motion_state.h"
#include "integration/simd_vector.h"

namespace whirl_twin {

namespace dormand_prince {

inline constexpr std::size_t kStages = 12;

inline constexpr std::array<double, kStages> kNodes{0.0,
                                                    0.526001519587677318785587544488e-01,
                                                    0.789002279381515978178381316732e-01,
                                                    0.118350341907227396726757197510,
                                                    0.281649658092772603273242802490,
                                                    0.333333333333333333333333333333,
                                                    0.25,
                                                    0.307692307692307692307692307692,
                                                    0.651282051282051282051282051282,
                                                    0.6,
                                                    0.857142857142857142857142857142,
                                                    1.0};

using Row = std::array<double, kStages>;
inline constexpr std::array<Row, kStages> kA{{
    {},
    {5.26001519587677318785587544488e-2},
    {1.97250569845378994544595329183e-2, 5.91751709536136983633785987549e-2},
    {2.95875854768068491816892993775e-2, 0.0, 8.87627564304205475450678981324e-2},
    {2.41365134159266685502369798665e-1, 0.0, -8.84549479328286085344864962717e-1,
     9.24834003261792003115737966543e-1},
    {3.7037037037037037037037037037e-2, 0.0, 0.0, 1.70828608729473871279604482173e-1,
     1.25467687566822425016691814123e-1},
    {3.7109375e-2, 0.0, 0.0, 1.70252211019544039314978060272e-1, 6.02165389804559606850219397283e-2,
     -1.7578125e-2},
    {3.70920001185047927108779319836e-2, 0.0, 0.0, 1.70383925712239993810214054705e-1,
     1.07262030446373284651809199168e-1, -1.53194377486244017527936158236e-2,
     8.27378916381402288758473766002e-3},
    {6.24110958716075717114429577812e-1, 0.0, 0.0, -3.36089262944694129406857109825,
     -8.68219346841726006818189891453e-1, 2.75920996994467083049415600797e1,
     2.01540675504778934086186788979e1, -4.34898841810699588477366255144e1},
    {4.77662536438264365890433908527e-1, 0.0, 0.0, -2.48811461997166764192642586468,
     -5.90290826836842996371446475743e-1, 2.12300514481811942347288949897e1,
     1.52792336328824235832596922938e1, -3.32882109689848629194453265587e1,
     -2.03312017085086261358222928593e-2},
    {-9.3714243008598732571704021658e-1, 0.0, 0.0, 5.18637242884406370830023853209,
     1.09143734899672957818500254654, -8.14978701074692612513997267357,
     -1.85200656599969598641566180701e1, 2.27394870993505042818970056734e1,
     2.49360555267965238987089396762, -3.0467644718982195003823669022},
    {2.27331014751653820792359768449, 0.0, 0.0, -1.05344954667372501984066689879e1,
     -2.00087205822486249909675718444, -1.79589318631187989172765950534e1,
     2.79488845294199600508499808837e1, -2.85899827713502369474065508674,
     -8.87285693353062954433549289258, 1.23605671757943030647266201528e1,
     6.43392746015763530355970484046e-1},
}};

inline constexpr Row kWeights{5.42937341165687622380535766363e-2,
                              0.0,
                              0.0,
                              0.0,
                              0.0,
                              4.45031289275240888144113950566,
                              1.89151789931450038304281599044,
                              -5.8012039600105847814672114227,
                              3.1116436695781989440891606237e-1,
                              -1.52160949662516078556178806805e-1,
                              2.01365400804030348374776537501e-1,
                              4.47106157277725905176885569043e-2};

}  // namespace dormand_prince

struct DormandPrince8 {
  static constexpr const char* kName = "dormand_prince_8";

  void restart() {}

  /// Advances by h [s] from offset [s] after the start of the twin's step.
  template <std::size_t n, class Equation>
  WHIRL_TWIN_INLINE StepStatus step(const Equation& equation, double offset, double h,
                                    MotionState<n>& state) {
    using dormand_prince::kA;
    using dormand_prince::kNodes;
    using dormand_prince::kStages;
    using dormand_prince::kWeights;
    using SimdVector = whirl_twin::SimdVector<n>;
    const SimdVector q0(state.q);
    const SimdVector v0(state.v);
    std::array<SimdVector, kStages> rates;
    std::array<SimdVector, kStages> accelerations;
    SimdVector q = q0;
    SimdVector v = v0;
    SimdVector dq{};
    SimdVector dv{};
    double energy = 0.0;
    // A loop, not twelve copies of the equations: what they make of the parameters alone is then
    // computed once a step.
    for (std::size_t k = 0; k < kStages; ++k) {
      rates[k] = v;
      // The next stage as far as it is known before this one's acceleration: its q entirely, so
      // that its sines can be computed early; of its v all but the last term.
      SimdVector q_next = q0;
      SimdVector v_next = v0;
      const std::size_t next = k + 1 < kStages ? k + 1 : k;
      SimdVector q_sum{};
      SimdVector v_sum{};
      for (std::size_t j = 0; j < k; ++j) {
        q_sum.add(kA[next][j], rates[j]);
        v_sum.add(kA[next][j], accelerations[j]);
      }
      q_next.add(h, q_sum);
      q_next.add(h * kA[next][k], v);
      v_next.add(h, v_sum);

      const auto found = equation(q.array(), v.array(), offset + kNodes[k] * h);
      accelerations[k] = SimdVector(found.acceleration);
      v_next.add(h * kA[next][k], accelerations[k]);
      dq.add(h * kWeights[k], v);
      dv.add(h * kWeights[k], accelerations[k]);
      energy += h * kWeights[k] * found.power;
      q = q_next;
      v = v_next;
    }
    state.advance(dq.array(), dv.array(), energy);
    return StepStatus::kOk;
  }
};

}  // namespace whirl_twin
