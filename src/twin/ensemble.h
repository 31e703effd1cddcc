// Monte Carlo ensemble of a system: samples with different parameters, on the shaft of the system
// as in the scene, next to the twin.
//
// Samples are stepped with the system's method or an equivalent one: isotropic linear rotors on a
// shaft with prescribed motion are batched (integration/isotropic_rotors.h), without the audit of
// their energy. Samples that diverge stop; the others continue.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "integration/step_context.h"
#include "realtime/record_ring.h"
#include "realtime/state_image.h"
#include "scene/built_system.h"
#include "scene/scene.h"
#include "twin/record.h"

namespace whirl_twin {

/// The equations of the samples, stepped together.
class EnsembleSteps {
 public:
  virtual ~EnsembleSteps() = default;
  virtual const char* description() const = 0;  ///< for logs and reports
  /// Lowest and highest speed [rad/s] of the shaft that it is prepared for.
  virtual std::pair<double, double> speeds() const = 0;

  // Real-time safe.

  virtual void reset() noexcept = 0;
  /// One step from simulated time [s]; the drive is at its start.
  virtual void step(double time) noexcept = 0;
  /// Published quantities of each sample, and their largest magnitudes since the start: samples
  /// times quantities. NaN: the sample has stopped.
  virtual void write(double* values, double* peaks) const noexcept = 0;
  /// As Stepper::errorSum(), the largest one of some samples that have not stopped.
  virtual double errorSum() const noexcept = 0;
  /// Serializes all state, except the drive and the inputs.
  virtual void exchange(StateImage& image) noexcept = 0;
};

/// A number published for each sample.
struct EnsembleQuantity {
  std::string name;  ///< "radius", of the whirl about the equilibrium, or a coordinate
  std::string unit;
};

class Ensemble {
 public:
  /// Of a system of a scene, with its drive and inputs, which are common to all samples. Throws
  /// InputError with the number of a sample whose parameters are inconsistent or change the kind of
  /// the system; RunFailure if steps cannot be prepared.
  Ensemble(const Scene& scene, const BuiltSystem& system, const StepContext& excitation);

  std::size_t count() const { return count_; }
  const std::vector<EnsembleQuantity>& quantities() const { return quantities_; }
  /// Equilibrium [m] of the nominal system, if it is a rotor, at its first station and initial
  /// speed; (0, 0) if none was found.
  const Eigen::Vector2d& rest() const { return rest_; }
  /// The values drawn for a sample, in the order of spec.ensemble.spread.
  const std::vector<double>& drawn(std::size_t member) const { return drawn_[member]; }
  const EnsembleSteps& steps() const { return *steps_; }

  /// A record: the step, then values and peaks, each samples times quantities.
  std::size_t recordSize() const { return kValues + numbers() + numbers(); }
  std::int64_t stepOf(const double* record) const { return unpacked(record[kStep]); }
  const double* values(const double* record) const { return record + kValues; }
  const double* peaks(const double* record) const { return values(record) + numbers(); }

  // Real-time safe.

  void reset() noexcept;
  void step(double time) noexcept { steps_->step(time); }
  void exchange(StateImage& image) noexcept { steps_->exchange(image); }
  double errorSum() const noexcept { return steps_->errorSum(); }
  /// Steps between records; some fifty records a simulated second.
  std::int64_t period() const noexcept { return every_; }
  /// The current record.
  void write(std::int64_t step, double* record) const noexcept;
  /// Passes a record to the reader if it is due.
  void publish(std::int64_t step) noexcept;

  /// For the reader's thread: the newest record; false: already taken.
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
