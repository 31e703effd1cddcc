// A recorded run as the monitor sees it: a log replayed through it, faster than real time.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "messages/alert.h"
#include "messages/states.h"
#include "monitoring/alarm_settings.h"
#include "reports/csv_table.h"
#include "reports/figure.h"
#include "reports/recording.h"
#include "reports/report_page.h"
#include "scene/built_scene.h"
#include "signal/passed_resonance.h"
#include "signal/spectrum_cascade.h"

namespace whirl_twin {

/// An alert from the time it was raised until it cleared, as it was when it was worst.
struct AlertCourse {
  state::Alert worst;
  double raised = 0.0;                                        ///< [s], simulated
  double cleared = std::numeric_limits<double>::quiet_NaN();  ///< [s]; NaN: active at the end
  std::string why_cleared;
  std::string raised_at, cleared_at;  ///< ISO 8601, of a log that was recorded live; else ""
  /// [s], since when its cause had gone and it was latched; NaN: not so.
  double latched = std::numeric_limits<double>::quiet_NaN();
};

/// For how long what came from a system could not be judged.
struct NotOkCourse {
  std::string why;     ///< as published last
  double begin = 0.0;  ///< [s], simulated, of the newest state when it was published, to 0.1 s
  double end = std::numeric_limits<double>::quiet_NaN();  ///< [s]; NaN: so it was at the end
};

/// What is drawn of a system, ten values a second of simulated time, and its margins.
struct SystemCourse {
  std::string name;
  bool rotor = false;
  bool modelled = false;  ///< states of the twin were received, beside the measurements
  std::optional<OrderVector> slow_roll;  ///< subtracted from the measurements
  OrderCourse orders;
  std::vector<NotOkCourse> not_ok;
  std::vector<PassedResonance> resonances;  ///< that its run-ups and run-downs have passed
  std::vector<WindowSpectrum> spectra;      ///< as time went on
  std::optional<WindowSpectrum> spectrum;   ///< at the end, or where it was asked for
  /// The last turns of that window, of the shaft's middle less its mean in them; at most five.
  std::vector<state::WhirlState> orbit;
  std::vector<state::CriticalSpeedMargin> critical_speeds;  ///< of the model, as published last
  std::vector<double> time;                                 ///< [s], simulated
  std::vector<double> speed;  ///< [rad/s], of its shaft; NaN without one
  /// [m], the largest distance from the middle of the orbit since the value before; of rotors.
  std::vector<double> vibration;
  AmplitudeLevels levels;           ///< of its vibration; empty: none
  std::vector<double> margin_time;  ///< [s]
  std::vector<double> decay_rate;   ///< [1/s], of the slowest motion
  std::uint64_t states = 0;
  // Where the margin was least; NaN: it was never judged.
  double least_decay_rate = std::numeric_limits<double>::quiet_NaN();  ///< [1/s]
  double least_at = std::numeric_limits<double>::quiet_NaN();          ///< [s]
  double least_at_speed = std::numeric_limits<double>::quiet_NaN();    ///< [rad/s]
  std::string least_verdict;
};

struct MonitoredLog {
  std::string scene, log;
  double begin = 0.0, end = 0.0;  ///< [s], simulated: earliest and latest of what was watched
  double duration = 0.0;          ///< [s], by the stamps of the log, without silences beyond 10 min
  std::uint64_t watched = 0;      ///< messages that the monitor took
  std::uint64_t rejected = 0;     ///< that are invalid, or do not fit the scene
  std::uint64_t damaged = 0;      ///< places of the log that are no event
  std::string first_damage;       ///< where, and what; "": none
  std::vector<std::string> remarks;   ///< on a table
  std::uint64_t resets = 0;           ///< of simulated time
  std::vector<SystemCourse> systems;  ///< in the order of the scene
  std::vector<AlertCourse> alerts;    ///< as they were raised
};

/// Replays the recording of a twin or a machine; the monitor's wall time is that of its stamps.
/// advanced(bytes, of_bytes) is called now and then.
/// @param spectrum_at [s], simulated, where the window of the full spectrum ends; none: at the end
/// Throws InputError for a file that cannot be read, or holds no states of the scene's systems, or
/// none at that time.
MonitoredLog monitorLog(const BuiltScene& scene, const AlarmSettings& settings,
                        const Recording& recording, std::optional<double> spectrum_at,
                        const LogProgress& advanced);

std::string text(const MonitoredLog& run);
Json json(const MonitoredLog& run);
/// The alerts; resonances that were passed.
CsvTables tables(const MonitoredLog& run);
/// Speed, whirl and margin of a system over one time axis, its alerts behind them.
Figure figure(const MonitoredLog& run, const SystemCourse& system);
/// A page with all of it, figures inside.
ReportPage page(const MonitoredLog& run);

}  // namespace whirl_twin
