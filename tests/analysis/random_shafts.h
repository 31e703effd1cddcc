// Random flexible rotors that are difficult for methods of linear algebra.
#pragma once

#include <cmath>
#include <random>

#include "mechanics/rotors/rotor_assembly.h"

namespace whirl_twin {

struct RandomShaft {
  FlexibleShaft shaft;
  double speed = 0.0;  ///< [rad/s]
};

/// Optional elements: pedestals under some bearings, chains of them; a sleeve; a cone; the added
/// masses of oil films.
template <class Between>
void addFurther(const Between& between, FlexibleShaft& shaft) {
  for (const RotorBearing& bearing : shaft.bearings) {
    for (int i = static_cast<int>(between(0.0, 2.99)); i > 0; --i) {
      BearingCoefficients b;
      b.kxx = between(1.0e6, 1.0e8);
      b.kyy = between(1.0e6, 1.0e8);
      b.cxx = b.cyy = between(0.0, 1.0e4);
      const double mass = between(1.0, 300.0);
      shaft.pedestals.push_back({bearing.node, mass, mass * between(0.5, 2.0), b});
    }
  }
  ShaftSection sleeve = shaft.elements.front();
  sleeve.inner_diameter = sleeve.outer_diameter;
  sleeve.outer_diameter *= 1.5;
  shaft.sleeves.push_back({0, {{1.1e11, 4.1e10, 8800.0}, sleeve, between(0.0, 1.0)}});
  shaft.elements.back().outer_growth = 0.4 * shaft.elements.back().outer_diameter;
  shaft.bearings.front().coefficients.mxx = shaft.bearings.front().coefficients.myy =
      between(0.0, 20.0);
}

/// Unequal elements, up to six discs, bearings soft and all but rigid, at the ends or overhung,
/// isotropic or not, damped or not, cross-coupled (often beyond their threshold), shafts with and
/// without internal damping, below and far above their critical speeds.
inline RandomShaft randomShaft(unsigned seed, int elements) {
  std::mt19937 draws(seed);
  const auto between = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(draws);
  };
  const auto decades = [&](double low, double high) {
    return std::pow(10.0, between(std::log10(low), std::log10(high)));
  };
  const auto chance = [&](double p) { return between(0.0, 1.0) < p; };
  RandomShaft r;
  r.shaft.material = {2.11e11, 8.12e10, 7810.0};
  r.shaft.material.shear_deformation = chance(0.8);
  for (int i = 0; i < elements; ++i) {
    ShaftSection section;
    section.length = between(0.02, 0.12);
    section.outer_diameter = between(0.03, 0.1);
    section.inner_diameter = chance(0.2) ? 0.5 * section.outer_diameter : 0.0;
    r.shaft.elements.push_back(section);
  }
  const int discs = static_cast<int>(between(0.0, 7.0));
  for (int i = 0; i < discs; ++i) {
    const double mass = decades(1.0, 80.0);
    r.shaft.discs.push_back({static_cast<int>(between(0.0, elements + 0.99)), mass, 0.01 * mass,
                             chance(0.5) ? 0.0055 * mass : 0.012 * mass});
  }
  r.shaft.internal_damping = chance(0.4) ? decades(1.0e-7, 1.0e-5) : 0.0;
  const bool undamped = chance(0.2);
  const bool crossed = chance(0.4);
  const int overhang = chance(0.5) ? 0 : elements / 4;
  const int supports = chance(0.3) ? 3 : 2;
  for (int i = 0; i < supports; ++i) {
    BearingCoefficients b;
    b.kxx = decades(1.0e5, chance(0.3) ? 1.0e12 : 1.0e8);
    b.kyy = chance(0.5) ? b.kxx : b.kxx * between(0.3, 3.0);
    if (!undamped && chance(0.9)) {
      b.cxx = decades(1.0, 1.0e5);
      b.cyy = chance(0.5) ? b.cxx : b.cxx * between(0.3, 3.0);
    }
    if (crossed) {
      b.kxy = between(-1.0, 1.0) * std::min(b.kxx, 1.0e8);
      b.kyx = -b.kxy;
    }
    const int node = i == 2 ? elements / 2 : i == 0 ? overhang : elements - (overhang + 1) / 2;
    r.shaft.bearings.push_back({node, b});
  }
  r.speed = chance(0.15) ? 0.0 : decades(10.0, 5000.0);
  if (chance(0.5)) {
    addFurther(between, r.shaft);
  }
  return r;
}

}  // namespace whirl_twin
