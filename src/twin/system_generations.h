// What each system and each controller of a running twin has been: its dynamics, if it is a system,
// and its parameters, generation by generation. A change of parameters makes a new generation
// before the loop takes it over; the records say which one they are of. Safe to use from several
// threads, none of them the loop's.
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

/// A system or a controller from one change of its parameters to the next.
struct SystemGeneration {
  std::shared_ptr<const Dynamics> dynamics;  ///< null: a controller's
  state::ParameterChange parameters;         ///< without its instant
};

/// `which` counts the systems of the scene first, then its controllers.
class SystemGenerations {
 public:
  /// Generation 0 of each: as the scene says.
  explicit SystemGenerations(const Twin& twin);

  /// Takes a further generation, and returns its number.
  std::int64_t add(std::size_t which, SystemGeneration generation);
  /// Takes one under the number that it had where it comes from; those added later go on from it.
  void restore(std::size_t which, std::int64_t number, SystemGeneration generation);
  /// A generation that was added and not forgotten.
  std::shared_ptr<const SystemGeneration> at(std::size_t which, std::int64_t generation) const;
  /// Forgets generations before this one, but not 0, to which a reset returns.
  void forgetBefore(std::size_t which, std::int64_t generation);

 private:
  mutable std::mutex mutex_;
  std::vector<std::map<std::int64_t, std::shared_ptr<const SystemGeneration>>> known_;
  std::int64_t newest_ = 0;
};

}  // namespace whirl_twin
