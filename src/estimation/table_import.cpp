#include "estimation/table_import.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "algebra/constants.h"
#include "estimation/uff_file.h"
#include "messages/input_error.h"
#include "messages/names.h"
#include "messages/units.h"
#include "signal/voltage_pulses.h"

namespace whirl_twin {

namespace {

constexpr std::size_t kInMemory = 16'000'000;       // numbers
constexpr std::int64_t kImportBlock = 100'000'000;  // ns
constexpr std::int64_t kRowsOfBlock = 10'000;
constexpr double kHysteresis = 0.2;  // of the distance of two levels

}  // namespace

class TableImport::Body {
 public:
  Body(const std::string& path, const ImportSettings& settings,
       const std::vector<EstimatorSource>& sources)
      : settings_(settings), table_(openNumberTable(path, settings.table)) {
    settings.requireChannelsOf(sources);
    for (const EstimatorSource& source : sources) {
      if (!source.keyphasor) {
        addSource(source, sources);
      }
    }
    addCandidates(sources);
    table_->selectOverTime(selected_);
    std::vector<MeasuredColumn> columns;
    for (const std::size_t column : selected_) {
      columns.push_back({table_->columns()[column].heading, {}});
    }
    rows_ = readRows(*table_, std::move(columns), kInMemory);
    for (const EstimatorSource& source : sources) {
      if (source.keyphasor) {
        addPulses(source);
      }
    }
    if (sources_.empty() && pulses_.empty()) {
      std::vector<std::string> headings;
      for (const TableColumn& column : table_->columns()) {
        headings.push_back(column.heading);
      }
      throw InputError(fmt::format(
          "must have columns with the names of the scene's channels, {}; there are: {}{}",
          fmt::join(missing_, ", "), printable(fmt::format("{}", fmt::join(headings, ", ")), 300),
          table_->how()));
    }
    if (!missing_.empty()) {
      notes_.push_back(fmt::format("no column for {}", fmt::join(missing_, ", ")));
    }
    if (rows_.whole) {
      sortRows();
    }
  }

  std::vector<state::Measurement> next() {
    std::vector<state::Measurement> out;
    while (out.empty() && !ended_) {
      ended_ = !readRow();
      const bool full = rows_of_block_ > 0 &&
                        (instant_ - block_ >= kImportBlock || rows_of_block_ >= largest_block_);
      if (ended_ || full) {
        send(out);
      }
      if (!ended_) {
        takeRow();
      }
    }
    return out;
  }

  const NumberTable& table() const { return *table_; }
  std::vector<std::string> remarks() const {
    std::vector<std::string> all = table_->remarks();
    all.insert(all.end(), notes_.begin(), notes_.end());
    for (const ImportedPulses& pulses : pulses_) {
      all.push_back(fmt::format("{}: {} {}", pulses.how, pulses.count,
                                pulses.count == 1 ? "pulse" : "pulses"));
    }
    if (repeated_ > 0) {
      all.push_back(fmt::format("{} rows at the instant of the one before: left out", repeated_));
    }
    return all;
  }

 private:
  struct ImportedSource {
    state::Measurement message;       // under construction
    std::vector<std::size_t> at;      // of each channel, in a row
    std::vector<double> scale, zero;  // channel = scale (column - zero)
  };

  struct ImportedPulses {
    state::Measurement message;  // under construction
    std::size_t at = 0;          // in a row
    double to_volts = 1.0;
    VoltagePulses find;
    std::string how;
    std::int64_t count = 0;
  };

  std::size_t placeOf(std::size_t column) {
    const auto found = std::find(selected_.begin(), selected_.end(), column);
    const auto place = static_cast<std::size_t>(found - selected_.begin());
    if (found == selected_.end()) {
      selected_.push_back(column);
    }
    return place;
  }

  void addSource(const EstimatorSource& source, const std::vector<EstimatorSource>& sources) {
    ImportedSource imported;
    std::vector<std::string> missing;
    for (const EstimatorSource::Channel& channel : source.channels) {
      const auto alike = [&](const EstimatorSource& other) {
        const std::vector<std::string> names = other.names();
        return !other.keyphasor &&
               std::find(names.begin(), names.end(), channel.name) != names.end();
      };
      const bool unique = std::count_if(sources.begin(), sources.end(), alike) == 1;
      std::vector<std::string> names = {source.name + "/" + channel.name};
      if (unique) {
        names.push_back(channel.name);
      }
      ColumnImport given;
      std::optional<std::size_t> column;
      for (const std::string& name : names) {
        const auto found = settings_.channels.find(name);
        given = found == settings_.channels.end() ? given : found->second;
      }
      if (!given.column.empty()) {
        column = table_->column(given.column);
      }
      for (const std::string& name : names) {
        column = column ? column : table_->findColumn(name);
      }
      if (!column) {
        missing.push_back(names.back());
        continue;
      }
      imported.at.push_back(placeOf(*column));
      const ImportScale scale = importScale(channel, given, table_->columns()[*column]);
      imported.scale.push_back(scale.scale);
      imported.zero.push_back(scale.zero);
      imported.message.channel.push_back(channel.name);
      imported.message.unit.push_back(channel.unit);
      imported.message.deviation.push_back(channel.deviation);
    }
    if (missing.size() == source.channels.size()) {
      for (const EstimatorSource::Channel& channel : source.channels) {
        missing_.push_back(source.name + "/" + channel.name);
      }
    } else if (!missing.empty()) {
      table_->column(missing.front());  // reports what there is
    } else {
      imported.message.source = source.name;
      largest_block_ = std::min(largest_block_, state::Measurement::kMaxValues /
                                                    static_cast<std::int64_t>(imported.at.size()));
      sources_.push_back(std::move(imported));
    }
  }

  /// Columns that may be the voltage of a keyphasor.
  void addCandidates(const std::vector<EstimatorSource>& sources) {
    for (const EstimatorSource& source : sources) {
      if (!source.keyphasor) {
        continue;
      }
      std::optional<std::size_t> column = table_->findColumn(source.name + "/keyphasor");
      const std::vector<TableColumn>& columns = table_->columns();
      for (std::size_t i = 0; i < columns.size() && !column; ++i) {
        column = isKeyphasorName(columns[i].name, source.name) ||
                         isKeyphasorName(columns[i].heading, source.name)
                     ? std::optional(i)
                     : column;
      }
      if (const KeyphasorImport* given = settings_.keyphasorOf(source.name)) {
        column = given->column.empty() ? column : table_->column(given->column);
      }
      if (column) {
        candidates_[source.name] = placeOf(*column);
      } else {
        missing_.push_back(source.name);
      }
    }
  }

  void addPulses(const EstimatorSource& source) {
    const auto candidate = candidates_.find(source.name);
    if (candidate == candidates_.end()) {
      return;
    }
    const TableColumn& column = table_->columns()[selected_[candidate->second]];
    ImportedPulses pulses;
    pulses.at = candidate->second;
    const double volts = unitScale(column.unit, "V");
    pulses.to_volts = volts == 0.0 ? 1.0 : volts;
    std::vector<double> values = rows_.columns[candidate->second].values;
    for (double& value : values) {
      value *= pulses.to_volts;
    }
    const VoltageLevels levels = levelsOf(std::move(values));
    const KeyphasorImport* const given = settings_.keyphasorOf(source.name);
    const KeyphasorImport known = given == nullptr ? KeyphasorImport() : *given;
    if (!known.threshold && !levels.two) {
      throw InputError(
          fmt::format("column {}: the voltage of a keyphasor must have two levels, or a threshold "
                      "and a slope in "
                      "the settings of the import; found {:.4g} to {:.4g} V",
                      inQuotes(column.heading), levels.low, levels.high));
    }
    const double threshold = known.threshold.value_or(0.5 * (levels.low + levels.high));
    const double hysteresis =
        known.hysteresis.value_or(levels.two ? kHysteresis * (levels.high - levels.low) : 0.0);
    const bool falling = known.slope.empty() ? levels.mostly_high : known.slope == "falling";
    pulses.find = VoltagePulses(threshold, hysteresis, falling);
    pulses.how = fmt::format("{} from column {}: {} through {:.4g} V, hysteresis {:.3g} V",
                             source.name, inQuotes(column.heading), falling ? "falling" : "rising",
                             threshold, hysteresis);
    pulses.message.source = source.name;
    pulses.message.channel = {"keyphasor"};
    pulses.message.unit = {"-"};
    pulses.message.deviation = {source.keyphasor->jitter};
    pulses_.push_back(std::move(pulses));
  }

  /// In the order of time, with the remarks of a run.
  void sortRows() {
    const std::int64_t origin = rows_.origin();
    MeasuredRun run = measuredRun(rows_.time(), std::move(rows_.columns), std::move(rows_.numbers));
    rows_.columns = std::move(run.columns);
    rows_.instants.clear();
    for (const double time : run.time) {
      rows_.instants.push_back(origin + std::llround(1.0e9 * time));
    }
    notes_.insert(notes_.end(), run.remarks.begin(), run.remarks.end());
  }

  bool readRow() {
    const std::int64_t before = instant_;
    while (true) {
      if (row_ < rows_.instants.size()) {
        instant_ = rows_.instants[row_];
        values_.clear();
        for (const MeasuredColumn& column : rows_.columns) {
          values_.push_back(column.values[row_]);
        }
        ++row_;
      } else {
        rows_ = {{}, {}, {}, 0, rows_.whole};
        row_ = 0;
        if (rows_.whole || !table_->next(values_)) {
          return false;
        }
        if (!table_->hasInstant()) {
          continue;
        }
        instant_ = table_->instant();
      }
      if (begun_ && instant_ < before) {
        throw InputError(
            fmt::format("{}: the time goes back from {:.9g} to {:.9g} s: rows of a table this long "
                        "must be in the order of time",
                        table_->place(), 1.0e-9 * static_cast<double>(before),
                        1.0e-9 * static_cast<double>(instant_)));
      }
      if (!begun_ || instant_ > before) {
        begun_ = true;
        return true;
      }
      ++repeated_;
    }
  }

  void takeRow() {
    block_ = rows_of_block_++ == 0 ? instant_ : block_;
    for (ImportedSource& source : sources_) {
      const bool any = std::any_of(source.at.begin(), source.at.end(),
                                   [&](std::size_t at) { return !std::isnan(values_[at]); });
      if (!any) {
        continue;  // a row of another source
      }
      source.message.instant.push_back(instant_);
      for (std::size_t c = 0; c < source.at.size(); ++c) {
        const double value = source.scale[c] * (values_[source.at[c]] - source.zero[c]);
        source.message.value.push_back(std::isnan(value) ? 0.0 : value);
        source.message.valid.push_back(std::isnan(value) ? 0 : 1);
      }
    }
    for (ImportedPulses& pulses : pulses_) {
      const double volts = pulses.to_volts * values_[pulses.at];
      if (const auto pulse = pulses.find.take(instant_, volts)) {
        pulses.message.instant.push_back(*pulse);
        pulses.message.value.push_back(1.0);
        ++pulses.count;
      }
    }
  }

  void send(std::vector<state::Measurement>& out) {
    const auto add = [&](state::Measurement& message) {
      if (message.instant.empty()) {
        return;
      }
      message.samples = static_cast<std::int64_t>(message.instant.size());
      message.first_instant = message.instant.front();
      message.valid.resize(message.value.size(), 1);
      message.at.time = 1.0e-9 * static_cast<double>(message.instant.back());
      message.at.stamp = std::max<std::int64_t>(0, message.instant.back());
      out.push_back(message);
      ++message.at.step;
      message.instant.clear();
      message.value.clear();
      message.valid.clear();
    };
    for (ImportedSource& source : sources_) {
      add(source.message);
    }
    for (ImportedPulses& pulses : pulses_) {
      add(pulses.message);
    }
    rows_of_block_ = 0;
  }

  const ImportSettings settings_;
  std::unique_ptr<NumberTable> table_;
  std::vector<std::size_t> selected_;  // columns of a row
  std::map<std::string, std::size_t> candidates_;
  std::vector<ImportedSource> sources_;
  std::vector<ImportedPulses> pulses_;
  std::vector<std::string> missing_, notes_;
  TableRows rows_;  // not yet taken, from row_ on
  std::size_t row_ = 0;
  std::vector<double> values_;
  std::int64_t instant_ = 0, block_ = 0;
  std::int64_t rows_of_block_ = 0, largest_block_ = kRowsOfBlock;
  std::size_t repeated_ = 0;
  bool begun_ = false, ended_ = false;
};

TableImport::TableImport(const std::string& path, const ImportSettings& settings,
                         const std::vector<EstimatorSource>& sources) {
  try {
    body_ = std::make_unique<Body>(path, settings, sources);
  } catch (const InputError& error) {
    throw InputError(path + ": " + error.what());
  }
}

TableImport::~TableImport() = default;
TableImport::TableImport(TableImport&&) noexcept = default;

std::vector<state::Measurement> TableImport::next() {
  return body_->next();
}

std::uint64_t TableImport::offset() const {
  return body_->table().offset();
}

std::uint64_t TableImport::size() const {
  return body_->table().size();
}

std::vector<std::string> TableImport::remarks() const {
  return body_->remarks();
}

}  // namespace whirl_twin
