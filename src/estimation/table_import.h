// Measurements of a machine in a table or a UFF file, as the messages that a log of it has: columns
// are the channels of the sensors of a scene, and the pulses of its keyphasors are found in the
// voltage of a pick-up (signal/voltage_pulses.h).
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "estimation/estimator_sources.h"
#include "estimation/import_settings.h"
#include "estimation/measured_run.h"
#include "messages/measurement.h"
#include "scene/table_reader.h"

namespace whirl_twin {

class TableImport {
 public:
  /// Opens the file, and reads its first rows, a long table only in part. Throws InputError, "PATH:
  /// ...": as TableReader, openUffFile() and measuredRun(); for a source of which only some
  /// channels have a column, columns in another unit, a voltage without two levels, and a file with
  /// nothing of the sources.
  TableImport(const std::string& path, const ImportSettings& settings,
              const std::vector<EstimatorSource>& sources);
  ~TableImport();
  TableImport(TableImport&&) noexcept;

  /// The messages of the next tenth of a second, those of a source in the order of time; none at
  /// the end. Throws InputError for a row that cannot be read.
  std::vector<state::Measurement> next();

  std::uint64_t offset() const;  ///< read so far, of size()
  std::uint64_t size() const;
  /// On the way the table is written, what is left out, and the pulses so far.
  std::vector<std::string> remarks() const;

 private:
  class Body;
  std::unique_ptr<Body> body_;
};

}  // namespace whirl_twin
