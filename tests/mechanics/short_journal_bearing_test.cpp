// The short journal bearing: reference case E05, the closed form of its film forces against the
// integrated pressure, and its coefficients against differences of its force.
#include "mechanics/rotors/short_journal_bearing.h"

#include <gtest/gtest.h>

#include <cmath>

#include "mechanics/gradient.h"
#include "mechanics/rotors/bearing_laws.h"
#include "reference_rotors.h"

namespace whirl_twin {
namespace short_journal_bearing_test {

struct Reference {
  nlohmann::json all = rotorCase("E05");
  const nlohmann::json& p = all["parameters"];
  ShortJournalBearing bearing{p["L"], p["D"], p["radial_clearance"], p["viscosity"]};
  double load = p["load"];
};

void expectNear(double found, double value, double relative, const char* what) {
  EXPECT_NEAR(found, value, relative * std::fabs(value)) << what;
}

TEST(ShortJournalBearing, hasTheReferenceCoefficients) {
  const Reference r;
  const auto table = expected(r.all, "table");
  const double rtol = table["rtol"];
  for (const auto& row : table["value"]) {
    const double speed = row["rpm"].get<double>() * kRpm;
    expectNear(r.bearing.eccentricity(r.load, speed), row["ecc_ratio"], rtol, "eccentricity");
    const BearingCoefficients k = r.bearing.coefficients(r.load, speed);
    expectNear(k.kxx, row["K"]["xx"], rtol, "kxx");
    expectNear(k.kxy, row["K"]["xy"], rtol, "kxy");
    expectNear(k.kyx, row["K"]["yx"], rtol, "kyx");
    expectNear(k.kyy, row["K"]["yy"], rtol, "kyy");
    expectNear(k.cxx, row["C"]["xx"], rtol, "cxx");
    expectNear(k.cxy, row["C"]["xy"], rtol, "cxy");
    expectNear(k.cyx, row["C"]["yx"], rtol, "cyx");
    expectNear(k.cyy, row["C"]["yy"], rtol, "cyy");
  }
}

TEST(ShortJournalBearing, carriesItsLoadAtTheStaticPosition) {
  const Reference r;
  for (const double speed : {1.0, 10.0, 157.0, 3000.0}) {
    const JournalPosition at = r.bearing.staticPosition(r.load, speed);
    const FilmForce<double> film = r.bearing.force(at.x, at.y, 0.0, 0.0, speed);
    EXPECT_NEAR(film.x, 0.0, 1e-10 * r.load) << speed;
    EXPECT_NEAR(film.y, r.load, 1e-10 * r.load) << speed;
    // Downwards, and carried along by the rotation: from below towards +x.
    EXPECT_LT(at.y, 0.0);
    EXPECT_GT(at.x, 0.0);
    EXPECT_NEAR(std::hypot(at.x, at.y), at.eccentricity * r.bearing.clearance, 1e-18);
  }
}

TEST(ShortJournalBearing, coefficientsAreDifferencesOfTheForce) {
  const Reference r;
  const double speed = 2000.0 * kRpm;
  const JournalPosition at = r.bearing.staticPosition(r.load, speed);
  const BearingCoefficients k = r.bearing.coefficients(r.load, speed);
  const double step = 1.0e-4 * r.bearing.clearance;
  const auto slope = [&](double dx, double dy, double dvx, double dvy) {
    const auto ahead = r.bearing.force(at.x + dx, at.y + dy, dvx, dvy, speed);
    const auto behind = r.bearing.force(at.x - dx, at.y - dy, -dvx, -dvy, speed);
    const double width = 2.0 * (dx + dy) + 2.0 * (dvx + dvy);
    return std::pair<double, double>{-(ahead.x - behind.x) / width, -(ahead.y - behind.y) / width};
  };
  // Central differences over 1e-4 of the clearance: errors of 1e-8 times the third derivative, some
  // tens of the first, and rounding of 1e-12. The velocity step is 1e-4 clearances per turn.
  const double tolerance = 1.0e-6 * std::fabs(k.kyx);
  const auto by_x = slope(step, 0.0, 0.0, 0.0);
  const auto by_y = slope(0.0, step, 0.0, 0.0);
  EXPECT_NEAR(by_x.first, k.kxx, tolerance);
  EXPECT_NEAR(by_x.second, k.kyx, tolerance);
  EXPECT_NEAR(by_y.first, k.kxy, tolerance);
  EXPECT_NEAR(by_y.second, k.kyy, tolerance);
  const double damping_tolerance = 1.0e-6 * k.cyy;
  const auto by_vx = slope(0.0, 0.0, step * speed, 0.0);
  const auto by_vy = slope(0.0, 0.0, 0.0, step * speed);
  EXPECT_NEAR(by_vx.first, k.cxx, damping_tolerance);
  EXPECT_NEAR(by_vx.second, k.cyx, damping_tolerance);
  EXPECT_NEAR(by_vy.first, k.cxy, damping_tolerance);
  EXPECT_NEAR(by_vy.second, k.cyy, damping_tolerance);
}

// The film's pressure summed over the half circle where it is positive, for journals anywhere that
// move anyhow.
TEST(ShortJournalBearing, forceIsThePressureOfHalfTheFilm) {
  const Reference r;
  const ShortJournalBearing& b = r.bearing;
  const double c = b.clearance;
  struct Motion {
    double x, y, vx, vy, speed;
  };
  for (const Motion& m : {Motion{0.3 * c, -0.2 * c, 10.0 * c, 40.0 * c, 150.0},
                          Motion{-0.6 * c, 0.5 * c, 200.0 * c, -90.0 * c, 150.0},
                          Motion{0.0, 0.7 * c, -30.0 * c, 5.0 * c, 0.0},
                          Motion{0.1 * c, 0.1 * c, 0.0, 0.0, -400.0}}) {
    double fx = 0.0;
    double fy = 0.0;
    // Midpoint rule on a half circle, whose ends do not matter: p = 0 there. The error falls with
    // the square of the number of intervals.
    const double start = std::atan2(2.0 * m.vy - m.speed * m.x, 2.0 * m.vx + m.speed * m.y);
    constexpr int kParts = 20000;
    for (int i = 0; i < kParts; ++i) {
      const double angle = start - 0.5 * kPi + kPi * (i + 0.5) / kParts;
      const double h = c - m.x * std::cos(angle) - m.y * std::sin(angle);
      const double wedge = m.speed * (m.x * std::sin(angle) - m.y * std::cos(angle));
      const double squeeze = -(m.vx * std::cos(angle) + m.vy * std::sin(angle));
      // Integral over the length of p = 6 mu (wedge + 2 squeeze) (z^2 - L^2 / 4) / (2 h^3).
      const double line =
          -0.5 * b.viscosity * std::pow(b.length, 3) * (wedge + 2.0 * squeeze) / (h * h * h);
      EXPECT_GE(line, 0.0);
      const double area = 0.5 * b.diameter * kPi / kParts;
      fx -= line * std::cos(angle) * area;
      fy -= line * std::sin(angle) * area;
    }
    const FilmForce<double> film = b.force(m.x, m.y, m.vx, m.vy, m.speed);
    const double tolerance = 1.0e-7 * std::hypot(fx, fy);
    EXPECT_NEAR(film.x, fx, tolerance);
    EXPECT_NEAR(film.y, fy, tolerance);
  }
}

// Neither sheared nor squeezed: no force, and slopes that a solver can use.
TEST(ShortJournalBearing, isSmoothAtRestInTheCentre) {
  const Reference r;
  using Dual = Gradient<double, 4>;
  for (const double speed : {0.0, 150.0}) {
    const auto film =
        r.bearing.force(Dual(0.0, 0), Dual(0.0, 1), Dual(0.0, 2), Dual(0.0, 3), Dual(speed));
    EXPECT_EQ(film.x.value, 0.0);
    EXPECT_EQ(film.y.value, 0.0);
    // Half of a full film: F = -pi mu R L^3 / (4 c^3) (2 v + w x J).
    const double damping = 0.5 * kPi * r.bearing.viscosity * 0.5 * r.bearing.diameter *
                           std::pow(r.bearing.length / r.bearing.clearance, 3);
    EXPECT_NEAR(film.x.slope[2], -damping, 1e-12 * damping);
    EXPECT_NEAR(film.y.slope[3], -damping, 1e-12 * damping);
    EXPECT_NEAR(film.x.slope[1], -0.5 * speed * damping, 1e-12 * (1.0 + speed) * damping);
    EXPECT_NEAR(film.y.slope[0], 0.5 * speed * damping, 1e-12 * (1.0 + speed) * damping);
  }
}

// Backwards it is the bearing in a mirror; at rest its coefficients stay finite and meet.
TEST(ShortJournalBearing, turnsBothWaysAndStands) {
  const Reference r;
  const BearingCoefficients forward = r.bearing.coefficients(r.load, 100.0);
  const BearingCoefficients backward = r.bearing.coefficients(r.load, -100.0);
  EXPECT_EQ(forward.kxx, backward.kxx);
  EXPECT_EQ(forward.kxy, -backward.kxy);
  EXPECT_EQ(forward.cyy, backward.cyy);
  EXPECT_EQ(forward.cxy, -backward.cxy);
  const SpeedBearing law = journalBearing(0, r.bearing, r.load);
  for (const double knot : law.knots) {
    const double step = 1.0e-9 * knot;
    const double below = law.coefficients(knot - step).kxy;
    EXPECT_NEAR(law.coefficients(knot + step).kxy, below, 1e-7 * std::fabs(below));
  }
  EXPECT_EQ(law.coefficients(0.0).kxy, 0.0);
  EXPECT_GT(law.coefficients(0.0).kyy, 0.0);
}

TEST(BearingTable, passesThroughItsRowsWithoutOvershoot) {
  const auto row = [](double speed, double k) {
    return BearingRow{speed, {k, 0.0, 0.0, 2.0 * k, 0.0, 0.0, 0.0, 0.0}};
  };
  const SpeedBearing bearing =
      tabulatedBearing(1, {row(100.0, 5.0), row(200.0, 1.0), row(300.0, 1.0), row(500.0, 9.0)});
  EXPECT_EQ(bearing.coefficients(0.0).kxx, 5.0);
  EXPECT_EQ(bearing.coefficients(200.0).kyy, 2.0);
  EXPECT_EQ(bearing.coefficients(1e4).kxx, 9.0);
  double before = 1e9;
  for (double speed = 100.0; speed <= 300.0; speed += 1.0) {
    const double k = bearing.coefficients(speed).kxx;
    EXPECT_LE(k, before) << speed;
    EXPECT_GE(k, 1.0) << speed;
    before = k;
  }
  // Once differentiable at its knots: the slope from both sides, by chords of 1e-5 rad/s.
  const auto chord = [&](double from, double to) {
    return (bearing.coefficients(to).kxx - bearing.coefficients(from).kxx) / (to - from);
  };
  EXPECT_NEAR(chord(199.99999, 200.0), chord(200.0, 200.00001), 1e-6);
  EXPECT_NEAR(chord(299.99999, 300.0), chord(300.0, 300.00001), 1e-6);
}

}  // namespace short_journal_bearing_test
}  // namespace whirl_twin
