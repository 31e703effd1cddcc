// How the members of an ensemble are stepped: side by side in vectors where their equations allow
// it, else one by one.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "integration/isotropic_rotors.h"
#include "models/model_info.h"
#include "scene/scene.h"
#include "twin/ensemble.h"

namespace whirl_twin {

struct EnsembleMember {
  SystemSpec spec;
  ModelSetup setup;
  Eigen::Vector2d rest = Eigen::Vector2d::Zero();  ///< [m], of a rotor: whirl is about this place
};

constexpr std::size_t kMostSampled = 8;  ///< members, whose errors are measured

/// These, evenly spread over so many.
std::vector<std::size_t> sampledMembers(std::size_t count);

/// A system as one complex number, if it is an isotropic linear rotor of one disc, free of what
/// turns with the shaft; a matrix isotropic but for rounding is not.
std::optional<IsotropicRotor> isotropicRotor(const Dynamics& dynamics, const SystemSpec& spec);

/// [rad/s], of either sign, that the drive is ever told to have.
double highestSpeed(const Drive& drive);

/// Of a step: with more of them one by one is faster.
constexpr int kMostPartsSideBySide = 64;

/// Of at least one member, with the scene's step [s]. The excitation outlives it.
std::unique_ptr<EnsembleSteps> ensembleSteps(const std::vector<EnsembleMember>& members,
                                             const std::string& integrator,
                                             const Excitation& excitation, double step);

}  // namespace whirl_twin
