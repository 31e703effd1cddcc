// Cost of a command, announced before it runs: from the sizes of the request and
// coefficients measured on one machine, to a factor of three or so. What takes more than ten
// seconds is announced; what takes more than a day, or more memory than there is, is refused,
// unless it is insisted on.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "analysis/stability.h"
#include "scene/built_scene.h"

namespace whirl_twin {

struct AskedCost {
  double seconds = 0.0;  ///< [s], of a processor
  double memory = 0.0;   ///< [bytes]
  std::string cause;     ///< the number that it grows with: "rotor: 404 coordinates"

  /// Of both; the cause is that of the dearer.
  AskedCost& operator+=(const AskedCost& other);
};

/// Preparing what one stepper of the system needs: tables of matrix exponentials of a rotor given
/// by its matrices, hardly anything of all others.
AskedCost costOfSteps(const BuiltScene& scene, std::size_t system);
/// Drawing and preparing the members of an ensemble, from a few of them, which are made.
AskedCost costOfMembers(const BuiltScene& scene, std::size_t system);
/// All that a run of the scene prepares.
AskedCost costOfRun(const BuiltScene& scene);

/// Of eigenvalues and responses of a system with so many coordinates.
AskedCost costOfAnalysis(const std::string& system, int coordinates,
                         std::size_t modes = kLowestModes);
AskedCost costOfCampbell(const std::string& system, int coordinates, int points);
AskedCost costOfResponse(const std::string& system, int coordinates, int points);
/// The roots of a polynomial with so many coefficients.
AskedCost costOfRoots(std::size_t coefficients, bool real);

/// [s] of the processor that the program has taken: on a busy machine its pace, too.
double processorTime();

/// A time in words: "40 s", "7 min", "11 h", "3 days", "12 years".
std::string durationText(double seconds);

/// Says on standard error what takes more than ten seconds. Throws InputError, with the cause, for
/// what takes more than a day or more memory than is free, unless `insist`.
void tell(const AskedCost& cost, bool insist);
/// A long run has been announced.
bool isAnnounced();

}  // namespace whirl_twin
