// The exact step of a linear rotor, at constant speed and in a run-up.
//
// At constant speed the step is e^(A h) of states and forcing together (rotor_map.h): no truncation
// error. The same holds for the forcing while the speed changes: with w_m the mean speed of the
// step the force is Re[F g(s) e^(i m (theta_0 + w_m s))], where g contains the change of speed and
// the tangential part; the relative error of its Legendre projection on cubics in s is at most (a
// h^2)^2 / 1e3. The exact angle of the drive is used throughout, and a breakpoint of its profile
// inside a step needs no special treatment: the projection is integrated piece by piece.
//
// The free motion is advanced by e^(A(w_m) h), which for matrices linear in the speed is the Magnus
// series to order two; its next term, h^3 a [A', A] / 12 (Blanes, Casas, Oteo & Ros, Physics
// Reports 470, 2009, section 4), is a change of variables, x^ = (1 + e A') x with e = the mean of
// theta - theta_0 - w_m s, - a h^2 / 12, applied at the start of the step and undone at its end.
// The residual is of order h^5 a and, like that term, does not accumulate from step to step.
//
// e^(A(w) h) over speed is a table: cells in which it is a cubic in the speed to 1e-12, a few rad/s
// wide. Matrix exponentials are computed at a dozen speeds in each smooth part of the range, and
// the cells from the polynomial through them (rotor_map.h).
//
// The audited work is y^T W y, exact, at constant speed, and a quadrature in a run-up
// (rotor_work.h). For a rotor with nodal forces (AppliedInputs::push()) it is y^T W(w_m) y in a
// run-up, too, W from the table: stiff forces cause a motion within the step that no quadrature
// resolves. The relative error of the work is then of order a h^2.
//
// Inputs are exact likewise (applied_inputs.h). A breakpoint of an input inside a step at constant
// speed divides it into sub-steps of 2^k nanoseconds, each exact; in a run-up the input is
// projected on a cubic, and the work is that of the projection.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "control/drive.h"
#include "integration/applied_inputs.h"
#include "integration/linear_stepper.h"
#include "integration/packed_matrix.h"
#include "integration/rotor_map.h"
#include "integration/rotor_work.h"
#include "integration/shaft_nodes.h"
#include "mechanics/linear_rotor.h"

namespace whirl_twin {

/// What of the work on the rotor a step audits.
enum class AuditedWork {
  kAll,
  kWithoutShaft,  ///< without that of the synchronous forces of a shaft with free spin
  kNone
};

class RotorStep {
 public:
  /// Prepares steps of h [s] for speeds [rad/s] between `speeds.first` and `speeds.second`, and the
  /// plain exact step for `constant_speeds`. Throws RunFailure for matrices
  /// beyond the range of doubles.
  RotorStep(const LinearRotor& rotor, double h, const std::pair<double, double>& speeds,
            const std::vector<double>& constant_speeds, const AppliedInputs& acting = {},
            AuditedWork audited = AuditedWork::kAll);

  double lowestSpeed() const { return boundaries_.front(); }  ///< [rad/s]
  double highestSpeed() const { return boundaries_.back(); }  ///< [rad/s]
  std::size_t cells() const { return cells_.size(); }         ///< of the table over speed

  /// Discards the history, after the motion has been set.
  void restart() noexcept { work_.restart(); }
  void exchange(StateImage& image) noexcept { image(work_); }

  /// The course over the next step of one of the forces that are no inputs (AppliedInputs::push()).
  /// Real-time safe.
  void push(std::size_t force, const std::array<double, 4>& course) noexcept {
    acting_.push(force, course);
  }
  /// Advances by h from offset [s] after the drive's begin(). Real-time safe. kOutOfRange, with the
  /// motion left as it was, where the mean speed is not between those prepared for.
  StepStatus advance(const Drive& drive, double offset, LinearMotion& motion) noexcept;
  /// The same by the table over speed, without the work: for steps that are repeated in an
  /// iteration. Shaft: a Drive or a ShaftCourse.
  template <class Shaft>
  StepStatus move(const Shaft& drive, double offset, LinearMotion& motion) noexcept;
  /// [J], of the last move(), from a state (q, v) to another.
  template <class Shaft>
  double work(const Shaft& drive, double offset, const Eigen::VectorXd& from,
              const Eigen::VectorXd& to) noexcept;
  /// What advance() would start from at one of the constant speeds, in the order of RotorMap with
  /// degree 0, valid until it is called; nullptr at any other speed. Real-time safe.
  const double* constantStart(const Drive& drive, double offset, const LinearMotion& motion,
                              std::size_t& which) noexcept;
  /// At one of the constant speeds, held until `to`: advances from one instant to another, both in
  /// [ns] after begin(), exactly, across breakpoints of the inputs. False, with nothing done, at
  /// any other speed and where no input is a table. Real-time safe.
  bool advanceInParts(const Drive& drive, std::int64_t from, std::int64_t to,
                      LinearMotion& motion) noexcept;

 private:
  static constexpr int kDegree = 3;  ///< of g over the step, and of the table over speed

  struct ConstantSpeed {
    double speed;
    PackedMatrix map;                 ///< B and W
    std::vector<PackedMatrix> parts;  ///< of 1, 2, 4 ... ns; where an input is a table
  };
  struct Cell {
    double centre, half_width;  ///< [rad/s]
    PackedMatrix increment;     ///< B_0 ... B_3 side by side: B = sum of s^k B_k
    PackedMatrix slope;         ///< A' from s (q, v), (q, v) to accelerations; may be empty
    RotorWorkCell work;
  };

  void prepare(const LinearRotor& rotor, const std::pair<double, double>& speeds);
  Cell cell(const LinearRotor& rotor, const MapOverSpeed& map, double low, double high) const;
  double relativeError(const Eigen::MatrixXd& error, const Eigen::MatrixXd& exact) const;
  double cubicError(const MapOverSpeed& map, double low, double high) const;
  ConstantSpeed* constantAt(double speed) noexcept;
  Eigen::Index startOf(const ShaftMotion& shaft, double offset, std::int64_t piece,
                       const LinearMotion& motion) noexcept;
  void constantStep(PackedMatrix& map, const ShaftMotion& shaft, double offset, std::int64_t piece,
                    LinearMotion& motion) noexcept;
  template <class Shaft>
  Cell* cellOf(const Shaft& drive, double offset) noexcept;
  Cell* cellAt(double speed) noexcept;
  void changingStep(Cell& cell, const LinearMotion& motion) noexcept;
  Eigen::Index tableInputs() const;
  Eigen::MatrixXd tableMap(const LinearRotor& rotor, double speed) const;
  bool stiffnessChanges(const LinearRotor& rotor, const std::pair<double, double>& speeds) const;
  Eigen::MatrixXd cubic(const MapOverSpeed& map, double low, double high) const;
  void project() noexcept;
  void shear(Cell& cell, double s, double e, const double* rates) noexcept;

  Eigen::Index n_;
  double h_;
  std::vector<ForceChannel> channels_;
  AppliedInputs acting_;
  std::vector<ConstantSpeed> constant_;
  std::vector<double> boundaries_;  ///< [rad/s], of the cells
  std::vector<Cell> cells_;
  RotorWork work_;
  AuditedWork audited_;
  bool by_form_ = false;    ///< the work is y^T W y at any speed
  double form_work_ = 0.0;  ///< [J], of the last step of the table
  // Work space of a step.
  ShaftNodes nodes_;
  Eigen::VectorXd y_;       ///< inputs of a map
  Eigen::VectorXd powers_;  ///< y, s y, s^2 y, s^3 y
  Eigen::VectorXd result_;
  Eigen::VectorXd shear_;  ///< e A' x
  Eigen::VectorXd rates_;
  Eigen::VectorXd increment_;  ///< of q and v
};

}  // namespace whirl_twin
