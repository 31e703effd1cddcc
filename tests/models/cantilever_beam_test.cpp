// The cantilever beam: its frequencies, its static and steady deflections by closed form.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "../scene/scenes.h"
#include "twin/twin.h"

namespace whirl_twin {
namespace cantilever_beam_test {

using Eigen::VectorXd;

struct Beam {
  double mass_per_length = 2.0;     // kg/m
  double length = 1.5;              // m
  double bending_stiffness = 50.0;  // N m^2
  /// [rad/s], sqrt(EI / m L^4)
  double unit() const {
    return std::sqrt(bending_stiffness / (mass_per_length * std::pow(length, 4)));
  }
};

Scene sceneOfBeam(int modes, const std::string& more = "", const Beam& beam = {}) {
  return sceneOf("{step: 0.01, systems: {beam: {model: cantilever_beam, parameters: {" +
                 fmt::format("mass_per_length: {}, length: {}, bending_stiffness: {}, modes: {}",
                             beam.mass_per_length, beam.length, beam.bending_stiffness, modes) +
                 (more.empty() ? "" : ", " + more) + "}}}}");
}

/// Matrices and sums over the modes of one beam.
class BeamUnderTest {
 public:
  explicit BeamUnderTest(const Scene& scene)
      : twin_(scene), dynamics_(*twin_.systems()[0]->dynamics) {
    const VectorXd zero = VectorXd::Zero(dynamics_.dof());
    matrices_ = dynamics_.linearization(zero, zero, zero, {});
  }
  const Dynamics& dynamics() const { return dynamics_; }
  const Linearization& matrices() const { return matrices_; }
  double frequency(int mode) const {
    return std::sqrt(matrices_.stiffness(mode, mode) / matrices_.mass(mode, mode));
  }
  /// Tip amplitude of the steady motion at a frequency, of the force there is at a time.
  double steadyTip(double frequency, double time) const {
    const VectorXd zero = VectorXd::Zero(dynamics_.dof());
    const VectorXd force = dynamics_.residualForce(zero, zero, {time, 0.0, 0.0, 0.0});
    return force
        .cwiseQuotient(matrices_.stiffness.diagonal() -
                       frequency * frequency * matrices_.mass.diagonal())
        .sum();
  }

 private:
  Twin twin_;
  const Dynamics& dynamics_;
  Linearization matrices_;
};

TEST(CantileverBeam, OfTwoModesIsThatOfTheNotes) {
  const BeamUnderTest beam(sceneOfBeam(2));
  EXPECT_NEAR(beam.frequency(0) / Beam().unit(), 3.532731542836757, 1e-11);
  EXPECT_NEAR(beam.frequency(1) / Beam().unit(), 34.80689310820841, 1e-10);
}

TEST(CantileverBeam, OfManyModesIsTheExactOne) {
  // Roots of cosh cos = -1, squared. Upper bounds that come down with the number of modes.
  const BeamUnderTest beam(sceneOfBeam(10));
  EXPECT_NEAR(beam.frequency(0) / Beam().unit(), 3.5160152685001513, 1e-9);
  EXPECT_NEAR(beam.frequency(1) / Beam().unit(), 22.03449156466677, 1e-6);
  const BeamUnderTest finest(sceneOfBeam(30));
  EXPECT_NEAR(finest.frequency(0) / Beam().unit(), 3.5160152685001513, 1e-9);
  EXPECT_NEAR(finest.frequency(1) / Beam().unit(), 22.03449156466677, 1e-8);
}

TEST(CantileverBeam, HasTheLowerHalfOfItsFrequenciesToOnePercent) {
  // Rayleigh-Ritz: from above. Exact: (beta L)^2, from the third on beta L = (i - 1/2) pi to 1e-4.
  for (const int modes : {2, 3, 4, 6, 10, 20, 30}) {
    const BeamUnderTest beam(sceneOfBeam(modes));
    for (int i = 0; i < (modes + 1) / 2; ++i) {
      const double exact = i == 0   ? 3.5160152685001513
                           : i == 1 ? 22.03449156466677
                                    : std::pow((i + 0.5) * 3.14159265358979323846, 2);
      const double ratio = beam.frequency(i) / Beam().unit() / exact;
      EXPECT_GT(ratio, 1.0 - 1e-4) << "mode " << i + 1 << " of " << modes;
      EXPECT_LT(ratio, 1.01) << "mode " << i + 1 << " of " << modes;
    }
  }
}

TEST(CantileverBeam, HasDiagonalMatricesInItsModes) {
  const BeamUnderTest beam(sceneOfBeam(5, "damping_ratio: 0.02"));
  for (const Eigen::MatrixXd* matrix :
       {&beam.matrices().mass, &beam.matrices().stiffness, &beam.matrices().damping}) {
    EXPECT_TRUE(matrix->isDiagonal(0.0));
  }
  for (int i = 0; i < 5; ++i) {
    EXPECT_NEAR(beam.matrices().damping(i, i),
                0.04 * beam.frequency(i) * beam.matrices().mass(i, i), 1e-12);
  }
  // A mode of unit deflection at the tip: a quarter of the beam's mass, very nearly the same for
  // all modes of the exact beam.
  EXPECT_NEAR(beam.matrices().mass(0, 0), 0.25 * 2.0 * 1.5, 1e-6);
}

TEST(CantileverBeam, BendsByFL3Over3EIUnderAConstantTipForce) {
  // With two assumed modes or more the notes' shapes hold the exact deflection.
  for (const int modes : {2, 3, 8, 30}) {
    const BeamUnderTest beam(sceneOfBeam(modes, "tip_force: 3.0"));
    EXPECT_NEAR(beam.steadyTip(0.0, 0.0), 0.0675, 1e-11) << modes;
  }
  Twin twin(sceneOfBeam(3, "tip_force: 3.0, damping_ratio: 0.5"));
  std::vector<double> record(twin.layout().size);
  for (int i = 0; i < 2000; ++i) {  // 20 s: e^-78 of the slowest mode remains
    twin.step();
  }
  twin.write(record.data());
  const double* q = twin.layout().system(record.data(), 0).q();
  EXPECT_NEAR(q[0] + q[1] + q[2], 0.0675, 1e-13);
}

TEST(CantileverBeam, AnswersATipForceThatAlternates) {
  const BeamUnderTest beam(sceneOfBeam(2, "tip_force: 3.0, tip_force_frequency: 4.0"));
  EXPECT_NEAR(beam.steadyTip(4.0, 0.0), 0.09070762218361496, 1e-11);
}

TEST(CantileverBeam, AnswersTheMotionOfItsClamp) {
  // Y sin(20 t) at its peak, in units of sqrt(EI / m L^4) = 1.
  const Beam unit{1.0, 1.0, 1.0};
  const double peak = 3.14159265358979323846 / 40.0;
  const BeamUnderTest notes(sceneOfBeam(2, "base_motion: 1.0, base_motion_frequency: 20.0", unit));
  EXPECT_NEAR(notes.steadyTip(20.0, peak), -2.14958025947596, 1e-10);
  // Slow base motion makes it lag by the inertia of its own mass, a uniform load w = m W^2 Y: w L^4
  // / 8 EI.
  const double slow = 0.01;
  const BeamUnderTest beam(sceneOfBeam(4, "base_motion: 1.0, base_motion_frequency: 0.01", unit));
  const double load = slow * slow / 8.0;
  // The next term is (W / p1)^2 = 8e-6 of it.
  EXPECT_NEAR(beam.steadyTip(slow, 0.5 * 3.14159265358979323846 / slow), load, 1e-4 * load);
}

TEST(CantileverBeam, IsDrawnBentFromItsClamp) {
  const BeamUnderTest beam(
      sceneOfBeam(2, "tip_force: -3.0, base_motion: 0.2, base_motion_frequency: 1.0"));
  const double time = 0.5;
  const double base = 0.2 * std::sin(time);
  const VectorXd q = (VectorXd(2) << 0.3, -0.1).finished();
  const Sketch sketch = beam.dynamics().sketch(q, {time, 0.0, 0.0, 0.0});
  ASSERT_FALSE(sketch.rods.empty());
  EXPECT_NEAR(sketch.rods.front().from.z, base, 1e-15);
  EXPECT_NEAR(sketch.rods.back().to.x, 1.5, 1e-15);
  EXPECT_NEAR(sketch.rods.back().to.z, base + 0.2, 1e-14) << "the tip: the sum of all q";
  ASSERT_EQ(sketch.boxes.size(), 1u);
  EXPECT_EQ(sketch.boxes[0].at.z, base);
  ASSERT_EQ(sketch.arrows.size(), 1u);
  EXPECT_LT(sketch.arrows[0].to.z, sketch.arrows[0].from.z) << "the force pulls down";
}

TEST(CantileverBeam, TakesUpToThirtyModes) {
  try {
    sceneOfBeam(31);
    FAIL() << "was accepted";
  } catch (const SceneError& error) {
    EXPECT_STREQ(error.what(),
                 "test.yaml: systems.beam.parameters.modes: must be a whole number from 1 to 30, "
                 "found 31");
  }
}

}  // namespace cantilever_beam_test
}  // namespace whirl_twin
