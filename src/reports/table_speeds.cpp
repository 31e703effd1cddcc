#include "reports/table_speeds.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "algebra/constants.h"

namespace whirl_twin {

namespace {

/// Of films alone: they have no highest speed.
bool areFilms(const DataSpeeds& tables) {
  return std::isinf(tables.to);
}

}  // namespace

std::string beyondMark(const DataSpeeds& tables, double speed) {
  return tables.covers(speed) ? "" : "  " + beyondName(tables);
}

std::string beyondName(const DataSpeeds& tables) {
  return areFilms(tables) ? "outside the film range" : "outside the tables";
}

std::string beyondText(const DataSpeeds& tables) {
  if (areFilms(tables)) {
    return fmt::format(
        "{}, which carry their loads at eccentricities below 0.95 from {:.5g} rad/s ({:.5g} rpm) "
        "on: below, the journals touch and the coefficients are extrapolated",
        beyondName(tables), tables.from, tables.from / kRpm);
  }
  return fmt::format(
      "outside the tables of bearings and pedestals, which cover {:.5g} to {:.5g} rad/s ({:.5g} to "
      "{:.5g} rpm): extrapolated with the nearest row",
      tables.from, tables.to, tables.from / kRpm, tables.to / kRpm);
}

std::string beyondLine(const DataSpeeds& tables, double from, double to) {
  if (tables.covers(from) && tables.covers(to)) {
    return "";
  }
  return from == to ? fmt::format("  {}\n", beyondText(tables))
                    : fmt::format("  in part {}\n", beyondText(tables));
}

Json tableSpeedsJson(const DataSpeeds& tables) {
  return tables.everywhere() ? Json() : Json{tables.from, tables.to};
}

Json beyondJson(const DataSpeeds& tables, const std::vector<double>& speeds) {
  Json all = Json::array();
  for (const double speed : speeds) {
    all.push_back(!tables.covers(speed));
  }
  return all;
}

void shadeBeyond(const DataSpeeds& tables, double from, double to, bool named, Chart& chart) {
  const auto shade = [&](double low, double high) {
    if (low < high) {
      chart.bands.push_back({named ? beyondName(tables) : "", low, high, paler(ink::kBlack, 0.85)});
      named = false;
    }
  };
  shade(from, std::min(to, tables.from));
  shade(std::max(from, tables.to), to);
}

}  // namespace whirl_twin
