// Mutations of scene files: typical errors of editors, scripts, disks and users.
#pragma once

#include <cstdint>
#include <random>
#include <string>

namespace whirl_twin {

/// The text with one to four pieces of damage, chosen by the random numbers: the same ones give the
/// same text on every machine.
std::string mutated(std::string text, std::mt19937_64& random);

}  // namespace whirl_twin
