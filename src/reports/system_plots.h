// The course of a run, kept in memory, and its pictures: of the system to scale, over time, phase
// portrait or orbits, energies, ensemble.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "mechanics/dynamics.h"
#include "reports/figure.h"
#include "reports/sample_writer.h"
#include "scene/built_system.h"
#include "twin/ensemble.h"
#include "twin/twin.h"

namespace whirl_twin {

/// An output of a controller, as it acts.
struct CommandHistory {
  std::size_t controller = 0;  ///< of the scene
  std::size_t output = 0;      ///< of it
  std::string name;            ///< "force_x", of its system
  std::string unit;
  double limit = 0.0;  ///< [unit], of the actuator; 0: none
  std::vector<double> values;
};

/// Of one system, a value for each sample; NaN after it has stopped.
struct PlotHistory {
  std::vector<double> time;                             ///< [s]
  std::vector<std::vector<double>> coordinates, rates;  ///< [coordinate][sample]
  std::vector<double> kinetic, potential, jacobi;       ///< [J]
  std::vector<EvaluationPoint<double>> moments;         ///< of the shaft
  std::vector<double> speed;                            ///< [rad/s], of the shaft
  std::vector<double> whirl_x, whirl_y;                 ///< [m], where a rotor's whirl is seen
  std::vector<double> whirl_radius, whirl_phase;        ///< [m], [rad]; of a rotor
  std::vector<CommandHistory> commands;                 ///< of controllers that act on it
  std::vector<state::EnsembleState> ensemble;           ///< at some of the samples
};

class PlotHistoryWriter final : public SampleWriter {
 public:
  /// `systems`: which ones of the twin's; the twin outlives the writer. Of every so many samples
  /// (`ensemble_stride`) it also keeps the statistics of the ensembles.
  PlotHistoryWriter(const Twin& twin, std::vector<std::size_t> systems,
                    std::int64_t ensemble_stride);

  void write(const Observer& observer) override;
  void finish() override {}

  /// In the order of the systems.
  const std::vector<PlotHistory>& histories() const { return histories_; }

 private:
  void writeEnsemble(std::size_t system, PlotHistory& history);

  const Twin& twin_;
  std::vector<std::size_t> systems_;
  std::vector<PlotHistory> histories_;
  std::int64_t ensemble_stride_;
  std::int64_t samples_ = 0;
  std::vector<double> record_;  // of an ensemble
};

/// "name (unit)" over the time of the history; a value for each of its samples.
Chart historyChart(const PlotHistory& history, const std::string& name, const std::string& unit,
                   const std::vector<double>& values);
/// Of a speed [rad/s], with rpm on the right.
Chart speedChart(const PlotHistory& history, const std::string& name,
                 const std::vector<double>& values);

/// Largest less smallest of the finite values.
double spread(const std::vector<double>& values);

/// Of an ensemble at the end of a run, and of the system beside it.
Figure ensembleFigure(const Ensemble& ensemble, const PlotHistory& history);

/// Nothing for a model that has no sketch.
std::optional<SketchPicture> motionPicture(const std::string& title, const Dynamics& dynamics,
                                           const PlotHistory& history);

/// Whirl radius, phase lag where there is one to be seen, and the speed of the shaft, over time.
std::vector<Chart> rotorCharts(const PlotHistory& history);

/// When a rotor that changes its speed passes its critical speeds: named in the first chart, and
/// across all of them. Of a speed that is passed again and again (a controller holds it) nothing,
/// nor of a rotor that controllers hold: its critical speeds are theirs too.
void markCriticalSpeeds(const BuiltSystem& system, const PlotHistory& history,
                        std::vector<Chart>& charts);

/// At constant speed the whole path; else single turns of the shaft, the widest one among them.
Figure orbitFigure(const PlotHistory& history);

/// Nothing for what has no picture, not several places along a shaft, or no motion. The title is
/// left to be written.
std::optional<SketchPicture> shaftPicture(const Dynamics& dynamics, const PlotHistory& history);

struct SystemPlot {
  std::string kind;  ///< "picture", "time", "phase", "energy" or "ensemble"
  Json figure;
};

/// Its picture (where it has one), time history, phase portrait (of a rotor: orbit) and energies,
/// and its ensemble, at the end of the run, unless that is null.
std::vector<SystemPlot> systemPlots(const BuiltSystem& system, const Ensemble* ensemble,
                                    const PlotHistory& history);

}  // namespace whirl_twin
