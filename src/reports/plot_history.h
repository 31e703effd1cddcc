// The course of a run, kept in memory to be plotted.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "reports/sample_writer.h"

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
  std::vector<Moment<double>> moments;                  ///< of the shaft
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

}  // namespace whirl_twin
