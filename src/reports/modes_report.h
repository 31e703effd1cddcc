// What `twin modes` shows of one rotor: the modes of its model at a speed and, of a recorded log,
// those of the machine beside them.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "analysis/whirl_modes.h"
#include "estimation/mode_pairing.h"
#include "reports/csv_table.h"
#include "reports/figure.h"
#include "reports/rotor_record.h"
#include "reports/rotor_systems.h"
#include "reports/shown_units.h"
#include "signal/ambient_modes.h"

namespace whirl_twin {

/// Frequencies are of interest up to the last of so many modes, and by this factor beyond it.
inline constexpr std::size_t kModesOfInterest = 6;
inline constexpr double kBeyondLastMode = 1.25;

/// A measured mode, and what it is of the model.
struct ComparedMode {
  AmbientMode mode;
  std::optional<std::size_t> model;  ///< of ModesReport::model
  double assurance = 0.0;            ///< [-], of the shapes
  /// Of an elliptic whirl: how large its circle in the other sense is beside that of this one.
  double other_sense = 0.0;
};

struct ModesReport {
  const RotorSystem* system = nullptr;
  double speed = 0.0;  ///< [rad/s]
  std::vector<WhirlMode> model;
  // Of a log.
  std::string log;
  RecordCounts counts;
  std::vector<std::string> stations;  ///< names, of what is measured
  std::vector<bool> one_probe;        ///< of each: it shows one direction only
  std::optional<AmbientRecord> record;
  std::vector<ComparedMode> modes;
  std::vector<std::size_t> not_seen;  ///< of `model`, within the frequencies searched
  std::vector<std::string> notes;     ///< what is not identifiable from the record
};

/// The model's modes at a speed [rad/s], of a shaft of elements with all of them: of more than
/// kMaxCompleteCoordinates those of lowest frequency.
ModesReport modesReport(const RotorSystem& system, double speed);
/// And those identified from a record, at the speed that it kept for longest or at `speed`; `limit`
/// [rad/s]: of the frequencies searched, else a little beyond the model's sixth mode.
ModesReport modesReport(const RotorSystem& system, const RotorRecord& record,
                        std::optional<double> speed, std::optional<double> limit);

Json json(const ModesReport& report);
std::string text(const ModesReport& report, const ShownUnits& units = {});
/// The model's modes and their shapes, or those that were measured with the model's beside them.
CsvTables tables(const ModesReport& report);
/// The shapes of the `count` lowest modes of the model, in front of the shaft.
Figure figure(const ModesReport& report, std::size_t count, const ShownUnits& units = {});

}  // namespace whirl_twin
