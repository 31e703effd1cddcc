// How a table of measurements is assigned to the sensors of a scene (table_import.h).
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "estimation/estimator_sources.h"
#include "scene/table_dialect.h"

namespace whirl_twin {

struct ColumnImport {
  std::string column;  ///< "": that of the channel's name
  std::string unit;    ///< "": that of the heading, or the channel's
  std::string scale;   ///< of a voltage: "200 mV/mil"; "": it is none
  double gap = 0.0;    ///< [V], at 0
};

struct KeyphasorImport {
  std::string column;                           ///< "": found by its name
  std::optional<double> threshold, hysteresis;  ///< [V]
  std::string slope;                            ///< rising or falling; "": found
};

struct ImportSettings {
  TableSettings table;
  std::map<std::string, ColumnImport> channels;       ///< by channel, or source/channel
  std::map<std::string, KeyphasorImport> keyphasors;  ///< by source; "" if there is one only

  /// Throws InputError for a channel or a keyphasor that the sources do not have.
  void requireChannelsOf(const std::vector<EstimatorSource>& sources) const;
  /// Of this source; nullptr if nothing is given.
  const KeyphasorImport* keyphasorOf(const std::string& source) const;
};

/// channel = scale (column - zero)
struct ImportScale {
  double scale = 1.0, zero = 0.0;
};
/// Throws InputError for units that cannot be converted.
ImportScale importScale(const EstimatorSource::Channel& channel, const ColumnImport& given,
                        const TableColumn& column);

/// Is it a usual name of a keyphasor's column, or that of its source?
bool isKeyphasorName(const std::string& name, const std::string& source);

/// Of a YAML file with the keys of a table (scene/table_dialect.h), `columns` and `keyphasor`.
/// Throws InputError with all its errors.
ImportSettings readImportSettings(const std::string& path);

}  // namespace whirl_twin
