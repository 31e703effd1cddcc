// The equations of many members of one model, evaluated side by side in vectors.
#pragma once

#include <cstddef>

#include "mechanics/moment.h"

namespace whirl_twin {

class MemberEquations {
 public:
  /// Members go in blocks of so many; the last one of all fills what is left of the last block.
  static constexpr std::size_t kBlock = 32;

  virtual ~MemberEquations() = default;
  virtual std::size_t count() const noexcept = 0;
  virtual std::size_t dof() const noexcept = 0;
  /// Does the motion of a shaft enter?
  virtual bool hasShaft() const noexcept = 0;
  /// Is a coordinate an angle?
  virtual bool angular(std::size_t coordinate) const noexcept = 0;

  /// q'' of the members of a block: q, v and a have kBlock numbers for each coordinate in turn.
  /// Real-time safe.
  virtual void accelerate(std::size_t block, const double* q, const double* v,
                          const Moment<double>& at, double* a) const noexcept = 0;
};

}  // namespace whirl_twin
