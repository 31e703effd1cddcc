// What an order filter has found, as the message that tells it.
#pragma once

#include "messages/order_state.h"
#include "signal/order_filter.h"

namespace whirl_twin {

/// Without system and instant.
state::OrderState toldOrders(const OrbitEstimate& estimate);

}  // namespace whirl_twin
