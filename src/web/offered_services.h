// The services that clients may call: commands to the twin and to its monitor, with the fields of
// the services of the nodes.
#pragma once

#include <string>
#include <vector>

#include "twin/live_parameters.h"
#include "web/client_message.h"
#include "web/protocol.h"

namespace whirl_twin {

const std::vector<ServiceInfo>& offeredServices();

/// All values of a request, or none: hence they must be of one system or controller. Returns why
/// they are not, or "".
std::string readParameters(const std::vector<ParameterValue>& values, ParameterRequest& request);

/// Is it one of the monitor, and not of the twin?
bool isOfMonitor(const std::string& service);

}  // namespace whirl_twin
