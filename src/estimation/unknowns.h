// The unknowns of a fit as one vector: parameters of the system first, then offsets, scales and
// delays of sensors. An offset or a scale of a coordinate or input is one unknown for all runs that
// specify it, or one for each run.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "estimation/fit_study.h"
#include "scene/built_scene.h"

namespace whirl_twin {

struct Unknown {
  enum class Kind {
    kParameter,
    kChannelOffset,
    kChannelScale,
    kInputOffset,
    kInputScale,
    kInputDelay
  };

  Kind kind = Kind::kParameter;
  std::string subject;  ///< path of a parameter; name of a channel or an input
  std::string name;     ///< as reported: `mass1`, `theta1.offset`, `torque1.delay`
  std::string unit;     ///< "" where not known, of a path into a table
  double start = 0.0;
  double least = 0.0, most = 0.0;                 ///< may be infinite
  std::optional<std::size_t> run = std::nullopt;  ///< the only one that uses it

  bool concerns(std::size_t a_run) const { return !run || *run == a_run; }
  /// Reference magnitude of its changes at this value; 0 if it has none.
  double size(double value) const { return std::fmax(std::fabs(value), std::fabs(start)); }
};

/// The unknowns of a study, in order. Parameters that must not be negative have 0 as lower bound.
std::vector<Unknown> unknownsOf(const FitStudy& study, const SharedSystem& system);

/// A study at one point: the system with these parameters, and its runs with these offsets, scales
/// and delays.
struct Candidate {
  SharedSystem system;
  std::vector<StudyRun> runs;                    ///< without `data`
  std::vector<std::vector<InputSignal>> inputs;  ///< of each run, in the order of the model
};

class CandidateMaker {
 public:
  /// The study must outlive it.
  explicit CandidateMaker(const FitStudy& study);

  /// The unknowns of one run alone, all others fixed at these values.
  CandidateMaker ofRun(std::size_t run, const Eigen::VectorXd& theta) const;

  const std::vector<Unknown>& unknowns() const { return unknowns_; }
  const BuiltScene& scene() const { return scene_; }
  /// Throws InputError for parameters that are invalid for the model.
  Candidate at(const Eigen::VectorXd& theta) const;

 private:
  const FitStudy& study_;
  BuiltScene scene_;
  std::vector<Unknown> known_;  ///< fixed, at these values:
  Eigen::VectorXd known_values_;
  std::vector<Unknown> unknowns_;
};

}  // namespace whirl_twin
