// Output of the state estimator of an asset: the estimated parameters, the difference between
// measurement and prediction, and the status of sensors and clocks.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "messages/fields.h"
#include "messages/states.h"

namespace whirl_twin::state {

/// Use of a channel's newest samples.
enum class ChannelStatus : std::uint8_t {
  kUsed = 0,     ///< by the filter
  kSilent = 1,   ///< no sample received
  kRefused = 2,  ///< innovation too large
  kInvalid = 3,  ///< flagged as invalid, or not finite
};

struct FollowState {
  static constexpr MessageKind kKind{"follow", "FollowState", "*/follow"};
  static constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

  Instant at;  ///< time: the twin's, to which the plant's time stamps are converted
  std::string system;

  // Estimated parameters of the model.
  std::vector<std::string> parameter;  ///< paths, as in the scene
  std::vector<std::string> parameter_unit;
  std::vector<double> value;      ///< [parameter_unit]
  std::vector<double> deviation;  ///< its standard deviation; NaN: unknown

  // Measured channels.
  std::vector<std::string> channel;  ///< SOURCE/CHANNEL of a Measurement
  std::vector<std::string> channel_unit;
  std::vector<double> residual;              ///< [channel_unit], measurement minus prediction; NaN:
                                             ///< none
  std::vector<double> residual_deviation;    ///< expected by the filter; NaN: unknown
  std::vector<double> offset;                ///< [channel_unit], of the sensor; NaN: not estimated
  std::vector<std::uint8_t> channel_status;  ///< a ChannelStatus

  // Statistics of the normalized residuals over a window: their mean square, 1 if the model agrees
  // with the plant, and their correlation with the previous ones, then 0. The limits correspond to
  // a rate of false alarms; NaN: not enough data.
  double mismatch = kNone;         ///< [-]
  double mismatch_least = kNone;   ///< [-], lower limit: the residuals are smaller than the model's
                                   ///< noise allows
  double mismatch_limit = kNone;   ///< [-], above: larger
  double whiteness = kNone;        ///< [-]
  double whiteness_limit = kNone;  ///< [-], limit of its magnitude

  // The parameter with the largest drift from its reference, if one is beyond the limit.
  std::string drift_parameter;  ///< "": none
  double drift_from = kNone;    ///< the reference, in its unit
  double drift_to = kNone;      ///< in its unit
  double drift_since = kNone;   ///< [s], `time` when it began
  double drift = kNone;         ///< [-], test statistic of the parameter nearest to its limit
  double drift_limit = kNone;   ///< [-]; NaN: no reference yet

  // Bearing loads.
  std::vector<std::string> bearing;
  std::vector<double> force_x;          ///< [N], on the shaft
  std::vector<double> force_y;          ///< [N]
  std::vector<double> force_deviation;  ///< [N], of each component; NaN: unknown

  // Samples since the start.
  std::int64_t used = 0;
  std::int64_t late = 0;      ///< came after their turn
  std::int64_t lost = 0;      ///< of blocks that never came
  std::int64_t repeated = 0;  ///< came twice
  std::int64_t invalid = 0;   ///< flagged as invalid, or not finite
  std::int64_t refused = 0;   ///< innovation too large

  double clock_offset = kNone;            ///< [s], the plant's clock minus the twin's
  double clock_offset_deviation = kNone;  ///< [s]
  double clock_drift = kNone;             ///< [-], gain in seconds per second
  bool shaft_known = false;               ///< the keyphasor yields the shaft angle
  double shaft_angle_deviation = kNone;   ///< [rad]; NaN: no shaft, or unknown

  template <class Visit>
  static void fields(Visit& visit) {
    const auto count = between(0, std::numeric_limits<std::int64_t>::max());
    const auto one_of_its_parameters = [](const char* name, const std::string& path,
                                          const auto& message) {
      const auto& all = message.parameter;
      if (!path.empty() && std::find(all.begin(), all.end(), path) == all.end()) {
        throw RejectedMessage(std::string(name) + ": expected one of its parameters, found " +
                              inQuotes(path));
      }
    };
    visit.head(TWIN_FIELD(system));
    const auto parameter = TWIN_FIELD(parameter);
    visit.array(TWIN_FIELD(parameters), parameter, "", each(requirePath), Stays::kSame);
    visit.along(parameter, TWIN_FIELD(parameter_unit), "", each(requireText));
    visit.along(parameter, TWIN_FIELD(value), "");
    visit.along(parameter, TWIN_FIELD(deviation), "", each(requireDeviation));
    const auto channel = TWIN_FIELD(channel);
    visit.array(TWIN_FIELD(channels), channel, "", each(requireChannel), Stays::kSame);
    visit.along(channel, TWIN_FIELD(channel_unit), "", each(requireText));
    visit.along(channel, TWIN_FIELD(residual), "");
    visit.along(channel, TWIN_FIELD(residual_deviation), "", each(requireDeviation));
    visit.along(channel, TWIN_FIELD(offset), "");
    visit.along(channel, TWIN_FIELD(channel_status), "", each(between(0, 3)));
    visit(TWIN_FIELD(mismatch), "-", requireDeviation);
    visit(TWIN_FIELD(mismatch_least), "-", requireDeviation);
    visit(TWIN_FIELD(mismatch_limit), "-", requireDeviation);
    visit(TWIN_FIELD(whiteness), "-");
    visit(TWIN_FIELD(whiteness_limit), "-", requireDeviation);
    visit(TWIN_FIELD(drift_parameter), "", one_of_its_parameters);
    visit(TWIN_FIELD(drift_from), "");
    visit(TWIN_FIELD(drift_to), "");
    visit(TWIN_FIELD(drift_since), "s");
    visit(TWIN_FIELD(drift), "-", requireDeviation);
    visit(TWIN_FIELD(drift_limit), "-", requireDeviation);
    const auto bearing = TWIN_FIELD(bearing);
    visit.array(TWIN_FIELD(bearings), bearing, "", each(requirePath), Stays::kSame);
    visit.numbersAlong(bearing, "N", TWIN_FIELD(force_x), TWIN_FIELD(force_y));
    visit.along(bearing, TWIN_FIELD(force_deviation), "N", each(requireDeviation));
    visit(TWIN_FIELD(used), "", count);
    visit(TWIN_FIELD(late), "", count);
    visit(TWIN_FIELD(lost), "", count);
    visit(TWIN_FIELD(repeated), "", count);
    visit(TWIN_FIELD(invalid), "", count);
    visit(TWIN_FIELD(refused), "", count);
    visit(TWIN_FIELD(clock_offset), "s");
    visit(TWIN_FIELD(clock_offset_deviation), "s", requireDeviation);
    visit(TWIN_FIELD(clock_drift), "-");
    visit(TWIN_FIELD(shaft_known), "", requireFlag);
    visit(TWIN_FIELD(shaft_angle_deviation), "rad", requireDeviation);
  }

 private:
  /// Not negative; NaN if unknown.
  static void requireDeviation(const char* field, double value) {
    if (value < 0.0) {
      throw RejectedMessage(std::string(field) + ": expected at least 0");
    }
  }

  static void requireChannel(const char* field, const std::string& path) {
    const std::size_t slash = path.find('/');
    if (slash == std::string::npos) {
      throw RejectedMessage(std::string(field) + ": expected SOURCE/CHANNEL, found " +
                            inQuotes(path));
    }
    requireName(field, path.substr(0, slash));
    requireName(field, path.substr(slash + 1));
  }
};

}  // namespace whirl_twin::state
