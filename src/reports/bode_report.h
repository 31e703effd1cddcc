// What `twin bode` shows: critical speeds, damping and slow roll of each probe, from a table of 1X
// vectors over the speed.
#pragma once

#include <string>
#include <vector>

#include "estimation/import_settings.h"
#include "reports/csv_table.h"
#include "reports/figure.h"
#include "signal/resonance_fit.h"

namespace whirl_twin {

struct MeasuredVectors {
  std::string probe;
  std::string
      unit;  ///< of the amplitude, "m" where the table has one of length; "": that of the table
  std::vector<SpeedVector> vectors;  ///< by speed; amplitudes from 0 to the peak
  ResonanceFit fit;
};

struct BodeReport {
  std::string file;
  std::vector<MeasuredVectors> probes;
  std::vector<std::string> remarks;
};

/// Columns by the words of their headings: `speed_rpm`; for each probe, in the order of the table,
/// an amplitude (`um pp`, `mil pk-pk`, `mm rms`; otherwise from 0 to the peak) and a phase (lag, or
/// `phase lead`; in deg, or rad). Throws InputError, "FILE: ...", for a table that has not these,
/// and for fewer than eight vectors of a probe.
BodeReport bodeReport(const std::string& file, const TableSettings& settings);

Json json(const BodeReport& report);
std::string text(const BodeReport& report);
CsvTables tables(const BodeReport& report);
/// Amplitude and phase lag over speed, less the slow roll, with the fit.
Figure figure(const BodeReport& report);

}  // namespace whirl_twin
