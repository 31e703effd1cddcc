#include "reports/rotor_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "algebra/constants.h"
#include "analysis/separation_margin.h"
#include "messages/input_error.h"
#include "reports/campbell_report.h"
#include "reports/critical_map_report.h"
#include "reports/modes_report.h"
#include "reports/report_page.h"
#include "reports/report_values.h"
#include "reports/response_report.h"
#include "reports/rotor_parts.h"
#include "reports/rotor_sheet.h"

namespace whirl_twin {

namespace {

constexpr std::size_t kModesDrawn = 6;
constexpr std::size_t kMaxModes = 12;
constexpr std::size_t kBranches = 12;
constexpr double kNear = 0.15;  // of a running speed: a critical speed to be named at the top

std::string numberOrDash(double value) {
  return std::isfinite(value) ? fmt::format("{:.5g}", value) : "–";
}

/// Puts a rotor's parts on the page, one after the other, and remembers what is missing.
class RotorReport {
 public:
  RotorReport(const BuiltScene& scene, const RotorSystem& system, const RotorReportRequest& request)
      : scene_(scene),
        system_(system),
        request_(request),
        u_(request.units),
        speed_(request.speed.value_or(system.highest_speed)),
        page_(fmt::format("{}, {}: rotor dynamics", scene.scene.name, system.name)) {}

  ReportPage page() {
    start();
    if (system_.shaft) {
      drawing();
      body();
      attempt("Critical speed map", [this] { map(); });
    } else {
      missing_.push_back(
          "Drawing, masses, sag, bearing loads, shear force, bending moment, critical speed map: "
          "only of a flexible_rotor, whose scene has its shaft and bearings");
    }
    attempt("Whirl modes", [this] { modes(); });
    attempt("Campbell diagram", [this] { campbell(); });
    attempt("Unbalance response", [this] { response(); });
    attempt("Stability, level I", [this] { levelOne(); });
    rest();
    return page_;
  }

 private:
  /// A part that is refused is left out whole.
  void attempt(const std::string& title, const std::function<void()>& part) {
    const ReportPage before = page_;
    try {
      page_.section(title);
      part();
    } catch (const InputError& inputError) {
      page_ = before;
      missing_.push_back(fmt::format("{}: {}", title, inputError.what()));
    } catch (const RunFailure& failure) {
      page_ = before;
      missing_.push_back(fmt::format("{}: {}", title, failure.what()));
    }
  }

  const BuiltSystem& built() const {
    return **std::find_if(scene_.systems.begin(), scene_.systems.end(),
                          [&](const SharedSystem& one) { return one->spec.name == system_.name; });
  }

  /// "83.224 rad/s (795 rpm)"
  std::string at(double speed) const {
    return fmt::format("{:.5g} {} ({})", u_.speed.in(speed), u_.speed.name,
                       u_.besideSpeed().shortText(speed));
  }

  /// Cells of a table: the speed in `unit`, and beside it.
  std::vector<std::string> cells(double speed, const ShownUnit& unit) const {
    const ShownUnit beside = unit.beside();
    return {numberOrDash(unit.in(speed)),
            fmt::format(beside.size == kRpm ? "{:.0f}" : "{:.5g}", beside.in(speed))};
  }

  bool inRange(double speed) const {
    return speed >= (1.0 - kNear) * system_.lowest_speed &&
           speed <= (1.0 + kNear) * system_.highest_speed;
  }

  /// For the box at the top: the crossings within kNear of the running speeds.
  void summarizeCrossings(const std::vector<CampbellCrossing>& crossings) {
    std::vector<std::string> near;
    for (const CampbellCrossing& c : crossings) {
      if (inRange(c.speed)) {
        near.push_back(fmt::format("{} {}", at(c.speed), name(c.mode.whirl)));
      }
    }
    page_.summary(fmt::format("Critical speeds within {:g} % of the running speeds: {}.",
                              100.0 * kNear,
                              near.empty() ? "none" : fmt::format("{}", fmt::join(near, "; "))));
  }

  void start() {
    const double low = system_.lowest_speed, high = system_.highest_speed;
    const std::string runs = low == high ? "running at " + at(high)
                                         : fmt::format("running from {} to {}", at(low), at(high));
    page_.text(fmt::format(
        "{}, {}. Modes and stability at {}. Units are SI (m, kg, s, N, rad) where none is given.",
        system_.model, runs, at(speed_)));
    const std::string& note = built().setup().note;
    if (!note.empty()) {
      page_.text("Model of the simulation: " + note + ".");
    }
    const DataSpeeds data = system_.tables();
    if (!data.covers(speed_)) {
      page_.text(fmt::format("{} is {}.", at(speed_), beyondText(data)));
    }
    if (!data.everywhere()) {
      missing_.push_back("Results marked \"" + beyondName(data) + "\" or shaded are " +
                         beyondText(data));
    }
  }

  void drawing() {
    page_.section("Drawing");
    page_.picture(drawingFigure(*system_.shaft));
    for (const PartsTable& table : partsTables(*system_.shaft, speed_)) {
      page_.part(table.title);
      page_.table(table.head, table.rows);
    }
  }

  void body() {
    const std::optional<RotorSheet> sheet = rotorSheet(built(), speed_);
    page_.section("Mass");
    page_.table(
        {"mass, kg", "centre of gravity from node 0, m", "polar inertia, kg m²",
         "transverse inertia about the centre of gravity, kg m²"},
        {{numberOrDash(sheet->body.mass), numberOrDash(sheet->body.centre),
          numberOrDash(sheet->body.polar_inertia), numberOrDash(sheet->body.transverse_inertia)}});
    if (!sheet->statics) {
      missing_.push_back("Sag and bearing loads: the rotor has a rigid-body mode");
      return;
    }
    page_.section("At rest under its weight");
    page_.text(fmt::format("Weight {} N, g = {} m/s², the bearing coefficients at {}.",
                           numberOrDash(sheet->body.mass * sheet->gravity),
                           numberOrDash(sheet->gravity), at(speed_)));
    std::vector<std::vector<std::string>> loads;
    for (const BearingLoad& bearing : sheet->statics->bearings) {
      loads.push_back({std::to_string(bearing.node), numberOrDash(bearing.force.y + 0.0),
                       numberOrDash(bearing.force.x + 0.0)});
    }
    page_.table({"bearing at node", "carries along y, N", "along x, N"}, loads);
    page_.picture(staticsFigure(*sheet));
  }

  void map() {
    const CriticalMapReport report = criticalMapReport(system_, {});
    page_.text(
        "Undamped forward critical speeds, every bearing of one stiffness in all directions on "
        "rigid "
        "ground; and the rotor's actual bearings over the speed.");
    page_.picture(figure(report, u_));
    std::vector<std::string> head{"stiffness, " + u_.stiffness.name};
    for (std::size_t mode = 0; mode < report.map.speeds.size(); ++mode) {
      head.push_back(fmt::format("mode {}, {}", mode + 1, u_.speed.name));
    }
    std::vector<std::vector<std::string>> rows;
    const std::size_t stride = std::max<std::size_t>(1, report.map.stiffness.size() / 10);
    for (std::size_t i = 0; i < report.map.stiffness.size(); i += stride) {
      rows.push_back({numberOrDash(u_.stiffness.in(report.map.stiffness[i]))});
      for (const std::vector<double>& mode : report.map.speeds) {
        rows.back().push_back(numberOrDash(u_.speed.in(mode[i])));
      }
    }
    rows.push_back({"rigid"});
    for (const double speed : report.map.rigid) {
      rows.back().push_back(numberOrDash(u_.speed.in(speed)));
    }
    page_.table(head, rows);
    if (!report.left_out.empty()) {
      missing_.push_back(
          fmt::format("Critical speed map: the bearings at nodes {} are left out, softer than a "
                      "tenth of the stiffest",
                      fmt::join(report.left_out, ", ")));
    }
    if (report.pedestals) {
      missing_.push_back(
          "Critical speed map: pedestals are left out, the stiffness is that of bearing and "
          "pedestal "
          "in series");
    }
  }

  void modes() {
    const ModesReport report = modesReport(system_, speed_);
    std::vector<std::vector<std::string>> rows;
    for (std::size_t k = 0; k < std::min(kMaxModes, report.model.size()); ++k) {
      const WhirlMode& mode = report.model[k];
      const std::vector<std::string> frequency = cells(mode.dampedFrequency(), u_.frequency);
      rows.push_back({std::to_string(k + 1), name(mode.whirl), frequency[0], frequency[1],
                      numberOrDash(mode.dampingRatio()), numberOrDash(mode.logDecrement()),
                      mode.eigenvalue.real() > 0.0 ? "grows" : "decays"});
    }
    page_.table({"mode", "whirl", u_.frequency.name, u_.frequency.beside().name, "damping ratio",
                 "log. decrement", ""},
                rows);
    const auto growing =
        std::count_if(report.model.begin(), report.model.end(),
                      [](const WhirlMode& mode) { return mode.eigenvalue.real() > 0.0; });
    page_.summary(fmt::format("Whirl modes at {}: {}.", at(speed_),
                              growing == 0 ? "none grows" : fmt::format("{} grow", growing)));
    page_.picture(figure(report, kModesDrawn, u_));
    if (report.model.size() > kMaxModes) {
      missing_.push_back(fmt::format("Whirl modes: {} are listed, of {} computed (`twin modes`)",
                                     kMaxModes, report.model.size()));
    }
  }

  void campbell() {
    const CampbellReport report =
        campbellReport(system_, SpeedRangeOptions{}.of(system_), {1.0}, kBranches);
    page_.picture(figure(report, u_));
    summarizeCrossings(report.diagram.crossings);
    std::vector<std::vector<std::string>> rows;
    for (const CampbellCrossing& crossing : report.diagram.crossings) {
      const std::vector<std::string> speed = cells(crossing.speed, u_.speed);
      rows.push_back({speed[0], speed[1], name(crossing.mode.whirl),
                      numberOrDash(crossing.mode.log_decrement),
                      beyondMark(system_.tables(), crossing.speed)});
    }
    if (rows.empty()) {
      page_.text("No whirl crosses the speed line in the range.");
    } else {
      page_.part("Where a whirl crosses the speed line");
      page_.table({u_.speed.name, u_.besideSpeed().name, "whirl", "log. decrement", ""}, rows);
    }
    if (report.beyond > 0) {
      missing_.push_back(
          fmt::format("Campbell diagram: {} crossings and undamped critical speeds above {}, where "
                      "the reduced-order rotor is not valid",
                      report.beyond, at(system_.rotor.highest_speed)));
    }
  }

  void response() {
    const ResponseReport report =
        responseReport(system_, SpeedRangeOptions{}.of(system_), std::nullopt);
    page_.picture(figure(report, u_));
    std::vector<std::vector<std::string>> rows;
    std::size_t too_near = 0;
    for (const CriticalSpeed& peak : report.peaks) {
      const state::CriticalSpeedMargin margin = criticalSpeedMargin(
          speed_, peak.speed, peak.forward ? "forward" : "backward", peak.amplification_factor);
      const bool damped = !(peak.amplification_factor >= kCriticallyDampedAmplification);
      const bool near = margin.separation_margin < margin.required_separation_margin;
      too_near += !damped && near;
      const std::vector<std::string> speed = cells(peak.speed, u_.speed);
      rows.push_back(
          {speed[0], speed[1], margin.direction, numberOrDash(u_.vibration.in(peak.peak)),
           std::isinf(peak.amplification_factor) ? "undamped"
                                                 : numberOrDash(peak.amplification_factor),
           numberOrDash(margin.separation_margin), numberOrDash(margin.required_separation_margin),
           damped ? "critically damped"
           : near ? "too near"
                  : "met"});
      rows.back().back() += beyondMark(system_.tables(), peak.speed);
    }
    page_.summary(fmt::format("Separation margins at {}: {}.", at(speed_),
                              too_near == 0 ? "met at every peak of the response"
                                            : fmt::format("too small at {} peaks", too_near)));
    page_.part(fmt::format("Amplification factors and separation margins at {}", at(speed_)));
    if (rows.empty()) {
      page_.text("The response has no peak in the range.");
    } else {
      page_.table({"peak, " + u_.speed.name, u_.besideSpeed().name, "whirl",
                   (u_.vibration.name == u_.length.name ? "semi-major axis, " : "major axis, ") +
                       u_.vibration.name,
                   "AF", "margin, %", "required, %", ""},
                  rows);
    }
    page_.list(separationConditions());
  }

  void levelOne() {
    LevelOneRequest request;
    request.speed = speed_;
    request.stages = request_.stages;
    const LevelOneReport report = levelOneReport(system_, request);
    page_.picture(figure(report, u_));
    std::vector<std::vector<std::string>> rows;
    rows.push_back(
        {"log. decrement without cross-coupling",
         report.rows.empty() ? "–" : numberOrDash(report.rows.front().mode.logDecrement())});
    const ShownUnit& stiffness = u_.stiffness;
    rows.push_back({"Q_0, where it ceases to decay, " + stiffness.name,
                    report.margin ? numberOrDash(stiffness.in(*report.margin)) : "none found"});
    if (report.applied) {
      rows.push_back(
          {"Q_A, of all stages, " + stiffness.name, numberOrDash(stiffness.in(*report.applied))});
      rows.push_back(
          {"log. decrement at Q_A",
           report.at_applied ? numberOrDash(report.at_applied->mode.logDecrement()) : "–"});
      rows.push_back(
          {"Q_0 / Q_A", report.margin ? numberOrDash(*report.margin / *report.applied) : "–"});
    }
    if (report.critical_speed_ratio) {
      rows.push_back({"speed to first critical speed on rigid bearings",
                      numberOrDash(*report.critical_speed_ratio)});
    }
    page_.table({"cross-coupled stiffness at " + report.station, ""}, rows);
    if (!report.applied) {
      missing_.push_back(
          "Stability, level I: the stages' stiffness is not known (--stage, --axial-stage)");
      return;
    }
    const std::vector<std::string> reasons = report.reasons();
    page_.summary(reasons.empty() ? "Stability, level I: met"
                                  : "Stability, level I: level II is required");
    page_.text(reasons.empty()
                   ? "Q_0/Q_A is 2 or more and the log. decrement at Q_A 0.1 or more. API 617 may "
                     "still require level II below Q_0/Q_A = 10, by its chart over the gas "
                     "density, which is not evaluated here."
                   : fmt::format("API 617 requires level II: {}.", fmt::join(reasons, "; ")));
  }

  void rest() {
    page_.section("Left out");
    missing_.push_back(
        "Torsion, axial vibration, nonlinear elements; forces in a fixed direction "
        "(`twin "
        "response --force`)");
    page_.list(missing_);
  }

  const BuiltScene& scene_;
  const RotorSystem& system_;
  const RotorReportRequest& request_;
  const ShownUnits& u_;
  double speed_;
  ReportPage page_;
  std::vector<std::string> missing_;
};

}  // namespace

ReportPage rotorReportPage(const BuiltScene& scene, const RotorSystem& system,
                           const RotorReportRequest& request) {
  speedOption("--speed", request.speed.value_or(0.0));
  return RotorReport(scene, system, request).page();
}

}  // namespace whirl_twin
