// The fields of an ensemble's statistics, as in message_fields.h: put into a message, and taken
// from one after asking whether they can be meant.
#pragma once

#include <cstdint>
#include <limits>
#include <string>

#include "messages/message_check.h"
#include "messages/states.h"

namespace whirl_twin {

/// Calls visit(name, of_from, of_to) for every statistic, an array with one entry per quantity.
template <class From, class To, class Visit>
void eachStatistic(From& from, To& to, Visit visit) {
  visit("mean", from.mean, to.mean);
  visit("standard_deviation", from.standard_deviation, to.standard_deviation);
  visit("smallest", from.smallest, to.smallest);
  visit("percentile_5", from.percentile_5, to.percentile_5);
  visit("percentile_25", from.percentile_25, to.percentile_25);
  visit("median", from.median, to.median);
  visit("percentile_75", from.percentile_75, to.percentile_75);
  visit("percentile_95", from.percentile_95, to.percentile_95);
  visit("largest", from.largest, to.largest);
  visit("peak_mean", from.peak_mean, to.peak_mean);
  visit("peak_standard_deviation", from.peak_standard_deviation, to.peak_standard_deviation);
  visit("peak_percentile_5", from.peak_percentile_5, to.peak_percentile_5);
  visit("peak_median", from.peak_median, to.peak_median);
  visit("peak_percentile_95", from.peak_percentile_95, to.peak_percentile_95);
  visit("peak_largest", from.peak_largest, to.peak_largest);
}

template <class Message>
void putFields(const state::EnsembleState& ensemble, Message& message) {
  message.count = ensemble.count;
  message.running = ensemble.running;
  message.quantity = ensemble.quantity;
  message.unit = ensemble.unit;
  eachStatistic(ensemble, message, [](const char*, const auto& from, auto& to) { to = from; });
}

template <class Message>
void takeFields(const Message& message, state::EnsembleState& ensemble) {
  requireRange("count", message.count, 1, std::numeric_limits<std::int64_t>::max());
  requireRange("running", message.running, 0, message.count);
  requireNames("quantity", message.quantity);
  requireLength("unit", message.unit.size(), message.quantity.size());
  for (const std::string& unit : message.unit) {
    requireCoordinateUnit(unit);
  }
  ensemble.count = message.count;
  ensemble.running = message.running;
  ensemble.quantity = message.quantity;
  ensemble.unit = message.unit;
  eachStatistic(message, ensemble, [&](const char* name, const auto& from, auto& to) {
    requireLength(name, from.size(), message.quantity.size());
    to = from;
  });
}

}  // namespace whirl_twin
