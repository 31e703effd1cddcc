// The lines the terminal display prints: one for each system's present state, one for each alert
// raised or cleared.
#pragma once

#include <string>
#include <vector>

#include "display/twin_listener.h"

namespace whirl_twin {

/// "rotor: speed 100.00 rad/s (954.9 rpm), vibration 123.4 um, lag 87.3 deg, ..." with the
/// available values.
std::string readoutText(const std::string& system, const SystemReadout& readout);

/// A line for each alert that is in one list and not in the other, or has changed its severity.
/// @param time [s], simulated, of the change
std::vector<std::string> alertChanges(const std::vector<Alert>& before,
                                      const std::vector<Alert>& now, double time);

/// "ALERTS OF 2 SYSTEMS INHIBITED for 840 s yet"; "" where none are.
std::string heldBackText(const MonitorStatus& monitor);

/// The first `columns` characters of a line, with "..." where it was truncated.
std::string fitted(const std::string& line, std::size_t columns);

}  // namespace whirl_twin
