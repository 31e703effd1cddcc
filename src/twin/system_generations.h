// Generations of each system and controller of a running twin: the dynamics of a system, and the
// parameters. A change of parameters makes a new generation before the loop uses it; records
// contain the number of their generation. Safe to use from several threads, except the loop's.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <vector>

#include "mechanics/dynamics.h"
#include "messages/states.h"
#include "twin/twin.h"

namespace whirl_twin {

/// A system or a controller between two changes of its parameters.
struct SystemGeneration {
  std::shared_ptr<const Dynamics> dynamics;  ///< null: a controller's
  state::ParameterChange parameters;         ///< without its instant
};

/// `which`: systems of the scene first, then its controllers.
class SystemGenerations {
 public:
  /// Generation 0 of each: the scene's.
  explicit SystemGenerations(const Twin& twin);

  /// Adds a generation and returns its number.
  std::int64_t add(std::size_t which, SystemGeneration generation);
  /// Adds one with a given number, from a checkpoint; later ones are counted from it.
  void restore(std::size_t which, std::int64_t number, SystemGeneration generation);
  /// A generation that was added and not forgotten.
  std::shared_ptr<const SystemGeneration> at(std::size_t which, std::int64_t generation) const;
  /// Removes generations before this one, except 0, which is used after a reset.
  void forgetBefore(std::size_t which, std::int64_t generation);

 private:
  mutable std::mutex mutex_;
  std::vector<std::map<std::int64_t, std::shared_ptr<const SystemGeneration>>> known_;
  std::int64_t newest_ = 0;
};

}  // namespace whirl_twin
