// Steps the samples of an ensemble: batched if their equations allow it, else one by one.
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
  Eigen::Vector2d rest = Eigen::Vector2d::Zero();  ///< [m], equilibrium of a rotor
};

constexpr std::size_t kMaxSampled = 8;  ///< samples whose errors are estimated

/// Their indices, uniform over `count`.
std::vector<std::size_t> sampledMembers(std::size_t count);

/// A system as one complex coordinate, if it is an isotropic linear rotor of one disc up to
/// synchronous forces; matrices may be anisotropic by rounding.
std::optional<IsotropicRotor> isotropicRotor(const Dynamics& dynamics, const SystemSpec& spec);

/// Largest magnitude of the speed [rad/s] in the drive's settings.
double highestSpeed(const Drive& drive);

/// Sub-steps per step; with more, stepping one by one is faster.
constexpr int kMaxPartsSideBySide = 64;

/// At least one sample, with the scene's step [s]. The excitation must outlive it.
std::unique_ptr<EnsembleSteps> ensembleSteps(const std::vector<EnsembleMember>& members,
                                             const std::string& integrator,
                                             const StepContext& excitation, double step);

}  // namespace whirl_twin
