// A system many times over, each member with parameters of its own, on the shaft of the system as
// the scene gives it: Monte Carlo over tolerances, beside the twin.
//
// Members are stepped with the system's method, or one as good: isotropic linear rotors on a shaft
// whose motion is prescribed go side by side in vectors (integration/isotropic_rotors.h), without
// the audit of their energy. Members that run away stop; the others go on.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "integration/excitation.h"
#include "realtime/record_ring.h"
#include "realtime/state_image.h"
#include "scene/built_system.h"
#include "scene/scene.h"
#include "twin/record.h"

namespace whirl_twin {

/// The members' equations, stepped together.
class EnsembleSteps {
 public:
  virtual ~EnsembleSteps() = default;
  virtual const char* description() const = 0;  ///< "side by side in vectors", "one by one"
  /// [rad/s], lowest and highest, of the shaft, that it is prepared for.
  virtual std::pair<double, double> speeds() const = 0;

  // Real-time safe.

  virtual void reset() noexcept = 0;
  /// One step from simulated time [s]; the drive stands at its start.
  virtual void step(double time) noexcept = 0;
  /// What is told of each member, and the largest magnitude of it since the start: members times
  /// quantities. NaN: the member has stopped.
  virtual void write(double* values, double* peaks) const noexcept = 0;
  /// As Stepper::errorSum(), the largest of a sample of the members that have not stopped.
  virtual double errorSum() const noexcept = 0;
  /// All that the next steps hang on, but what it was made of, and the drive and inputs.
  virtual void exchange(StateImage& image) noexcept = 0;
};

/// A number that is published of each member.
struct EnsembleQuantity {
  std::string name;  ///< "radius", of the whirl about where the member rests, or a coordinate
  std::string unit;
};

class Ensemble {
 public:
  /// Of a system of a scene, on its drive and with its inputs, which act on all members alike.
  /// Throws Refusal that names the member whose parameters do not fit together, or would make it a
  /// system of another kind; RunFailure where steps cannot be prepared.
  Ensemble(const Scene& scene, const BuiltSystem& system, const Excitation& excitation);

  std::size_t count() const { return count_; }
  const std::vector<EnsembleQuantity>& quantities() const { return quantities_; }
  /// [m]: where the system as given rests, if it is a rotor, at its first station and the speed it
  /// starts at; (0, 0) where no such place was found.
  const Eigen::Vector2d& rest() const { return rest_; }
  /// The values drawn of a member, of spec.ensemble.spread in its order.
  const std::vector<double>& drawn(std::size_t member) const { return drawn_[member]; }
  const EnsembleSteps& steps() const { return *steps_; }

  /// A record: the step, then values and peaks, each members times quantities.
  std::size_t recordSize() const { return kValues + numbers() + numbers(); }
  std::int64_t stepOf(const double* record) const { return unpacked(record[kStep]); }
  const double* values(const double* record) const { return record + kValues; }
  const double* peaks(const double* record) const { return values(record) + numbers(); }

  // Real-time safe.

  void reset() noexcept;
  void step(double time) noexcept { steps_->step(time); }
  void exchange(StateImage& image) noexcept { steps_->exchange(image); }
  double errorSum() const noexcept { return steps_->errorSum(); }
  /// Its statistics are told every so many steps, some fifty times a simulated second.
  std::int64_t period() const noexcept { return every_; }
  /// The present record.
  void write(std::int64_t step, double* record) const noexcept;
  /// Hands a record to the reader where it is due.
  void publish(std::int64_t step) noexcept;

  /// The reader's thread: the newest record; false: it has been taken.
  bool take(double* record) noexcept { return latest_.take(record); }

 private:
  enum { kStep, kValues };
  std::size_t numbers() const { return count_ * quantities_.size(); }

  std::size_t count_;
  std::vector<EnsembleQuantity> quantities_;
  Eigen::Vector2d rest_{0.0, 0.0};
  std::vector<std::vector<double>> drawn_;
  std::unique_ptr<EnsembleSteps> steps_;
  std::int64_t every_;  // steps from one record to the next
  LatestRecord latest_;
};

}  // namespace whirl_twin
