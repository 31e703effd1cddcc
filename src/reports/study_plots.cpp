#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <numeric>
#include <optional>
#include <utility>

#include "algebra/constants.h"
#include "reports/figure.h"
#include "reports/study_report.h"

namespace whirl_twin {

namespace {

constexpr std::uint64_t kMaxDots = 2000;  // of a scatter
constexpr std::uint64_t kFewDots = 60;    // that are drawn large
constexpr std::size_t kMaxClasses = 60;   // of a histogram
constexpr std::size_t kMaxBars = 25;      // numbers in a tornado
constexpr double kFence = 1.0;  // times the range from 1 % to 99 %, that a histogram goes beyond
const Pen kMeets{ink::kBlue, 3.0};
const Pen kMisses{ink::kVermilion, 3.0};

std::string axisOf(const Variation& variation) {
  return nameWithUnit(variation.path, variation.unit);
}

bool isLogarithmic(const Variation& variation) {
  return variation.distribution.kind == Distribution::Kind::kLogUniform;
}

/// One measure of a study, and all that is known of it.
class MeasurePlots {
 public:
  MeasurePlots(const Study& study, const StudyTable& table, const Answers& answers,
               std::size_t measure)
      : study_(study),
        answers_(answers),
        place_(measure),
        measure_(study.measures[measure]),
        values_(table.measures[measure]),
        label_(nameWithUnit(measure_.name, measure_.unit)),
        title_(fmt::format("{}: {} = {}", std::filesystem::path(study.source).stem().string(),
                           measure_.name, measure_.text)) {
    for (const Requirement& requirement : study.requirements) {
      if (requirement.measure == measure) {
        required_.push_back(requirement);
      }
    }
  }

  Figure histogram() const;
  Figure scatter() const;
  std::optional<BarChart> tornado() const;
  std::optional<ResponseMap> map() const;

 private:
  bool meets(double value) const {
    return std::all_of(required_.begin(), required_.end(),
                       [value](const Requirement& r) { return r.holds(value); });
  }
  std::string demands() const {
    std::vector<std::string> all;
    for (const Requirement& requirement : required_) {
      all.push_back(text(requirement, study_));
    }
    return fmt::format("{}", fmt::join(all, ", "));
  }
  std::vector<Series> dots(std::size_t number) const;
  Series course(std::size_t number) const;
  BarChart effects() const;

  const Study& study_;
  const Answers& answers_;
  std::size_t place_;  // of the measure
  const Measure& measure_;
  const std::vector<double>& values_;
  std::vector<Requirement> required_;
  std::string label_, title_;
};

Figure MeasurePlots::histogram() const {
  const Distributed& d = answers_.measures[place_];
  // A few that are far away do not leave the rest in one class.
  const double fence = kFence * (d.percentiles.back() - d.percentiles.front());
  double low = std::max(d.smallest, d.percentiles.front() - fence);
  double high = std::min(d.largest, d.percentiles.back() + fence);
  if (!(high > low)) {  // one value: a class of some width
    const double half = low == 0.0 ? 0.5 : 0.1 * std::fabs(low);
    high = low + half;
    low -= half;
  }
  const auto classes = static_cast<std::size_t>(std::clamp(
      std::ceil(std::sqrt(static_cast<double>(d.count))), 1.0, static_cast<double>(kMaxClasses)));
  const double width = (high - low) / static_cast<double>(classes);
  const auto last = static_cast<double>(classes - 1);
  std::vector<double> counts(classes);
  std::uint64_t beyond = 0;
  for (const double value : values_) {
    if (value >= low && value <= high) {
      const double at = (value - low) / width;  // not a number where the range is endless
      ++counts[at > 0.0 ? static_cast<std::size_t>(std::min(at, last)) : 0];
    } else if (std::isfinite(value)) {
      ++beyond;
    }
  }
  Chart chart;
  chart.x = {label_, false, true};
  chart.y.label = "points";
  Series bars;
  bars.fill = paler(ink::kBlue, 0.45);
  bars.line = false;
  Series edges;  // of the bars
  edges.pen = Pen{ink::kBlue, 1.0};
  const auto to = [&](double x, double y) {
    for (Series* series : {&bars, &edges}) {
      series->x.push_back(x);
      series->y.push_back(y);
    }
  };
  to(low, 0.0);
  for (std::size_t k = 0; k < classes; ++k) {
    to(low + width * static_cast<double>(k), counts[k]);
    to(low + width * static_cast<double>(k + 1), counts[k]);
    to(low + width * static_cast<double>(k + 1), 0.0);
  }
  chart.series = {bars, edges};
  const double top = *std::max_element(counts.begin(), counts.end());
  for (const Requirement& r : required_) {
    const double reach = 0.5 * (high - low);
    if (r.limit > low - reach && r.limit < high + reach) {
      Series limit{
          fmt::format("required: {}", text(r, study_)), {r.limit, r.limit}, {0.0, 1.05 * top}};
      limit.pen = Pen{ink::kVermilion, 2.4};
      chart.series.push_back(limit);
    }
  }
  if (chart.series.size() == 3) {  // a legend distinguishes them
    chart.series[0].name = fmt::format("{} points", d.count);
  }
  constexpr std::array<std::pair<std::size_t, const char*>, 3> kMarked{
      {{1, "5 %"}, {3, "median"}, {5, "95 %"}}};
  for (const auto& [percentile, name] : kMarked) {
    if (d.count >= 20 && d.largest > d.smallest) {
      chart.vertical.push_back({d.percentiles[percentile], name});
    }
  }
  std::string note;
  if (!required_.empty()) {
    std::uint64_t passed = 0;
    for (const double value : values_) {
      passed += meets(value) ? 1 : 0;
    }
    note += fmt::format("{:.4g} % of {} points meet {}",
                        100.0 * static_cast<double>(passed) / static_cast<double>(values_.size()),
                        values_.size(), demands());
  }
  if (beyond > 0) {
    note += fmt::format("{}{} are outside this range", note.empty() ? "" : "; ", beyond);
  }
  if (d.count < values_.size()) {
    note += fmt::format("{}{} failed or are undefined", note.empty() ? "" : "; ",
                        values_.size() - d.count);
  }
  chart.title = note;
  Figure figure;
  figure.title = title_;
  figure.charts = {chart};
  return figure;
}

/// Points that meet what is required, and those that do not.
std::vector<Series> MeasurePlots::dots(std::size_t number) const {
  Series meeting, missing;
  meeting.pen = kMeets;
  missing.pen = kMisses;
  if (!required_.empty()) {
    meeting.name = demands();
    missing.name = "not";
  }
  const bool large = study_.points() <= kFewDots;
  for (Series* series : {&meeting, &missing}) {
    series->line = !large;
    series->marks = large ? Marks::kDots : Marks::kNone;
  }
  const std::uint64_t count = std::min(study_.points(), kMaxDots);
  for (std::uint64_t k = 0; k < count; ++k) {
    // Any of them: every n-th would take one level of a grid.
    const std::uint64_t point =
        count < study_.points() ? permuted(k, study_.points(), study_.seed) : k;
    const double value = values_[point];
    if (std::isfinite(value)) {
      Series& series = meets(value) ? meeting : missing;
      series.x.push_back(study_.valuesAt(point)[number]);
      series.y.push_back(value);
      if (!large) {  // a line of one point is a dot
        series.x.push_back(kNaN);
        series.y.push_back(kNaN);
      }
    }
  }
  return {meeting, missing};
}

/// One at a time: over one number, the others as the scene has them.
Series MeasurePlots::course(std::size_t number) const {
  std::vector<std::pair<double, double>> spots;
  for (std::uint64_t point = 0; point < study_.points(); ++point) {
    const auto levels = levelsAt(study_.design, point);
    bool others = false;
    for (std::size_t j = 0; j < levels.size(); ++j) {
      others = others || (j != number && levels[j]);
    }
    if (!others && std::isfinite(values_[point])) {
      spots.emplace_back(study_.valuesAt(point)[number], values_[point]);
    }
  }
  std::sort(spots.begin(), spots.end());
  Series series;
  series.pen = Pen{ink::kBlue, 1.8};
  series.marks = spots.size() <= kFewDots ? Marks::kDots : Marks::kNone;
  for (const auto& [x, y] : spots) {
    series.x.push_back(x);
    series.y.push_back(y);
  }
  return series;
}

Figure MeasurePlots::scatter() const {
  Figure figure;
  figure.title = title_;
  figure.columns = study_.vary.size() > 1 ? 2 : 1;
  figure.width = study_.vary.size() > 1 ? 1100 : 800;
  figure.chart_height = study_.vary.size() > 1 ? 380 : 460;
  const bool by_one = study_.design.kind == Design::Kind::kOneAtATime ||
                      (study_.design.kind == Design::Kind::kGrid && study_.vary.size() == 1);
  for (std::size_t j = 0; j < study_.vary.size(); ++j) {
    Chart chart;
    chart.x = {axisOf(study_.vary[j]), isLogarithmic(study_.vary[j]), false};
    chart.y.label = label_;
    if (by_one) {
      chart.series = {course(j)};
    } else {
      chart.series = dots(j);
    }
    for (const Requirement& r : required_) {
      // Among dots there is no room for words, and their colours say it.
      chart.horizontal.push_back({r.limit, by_one ? text(r, study_) : ""});
    }
    figure.charts.push_back(chart);
  }
  return figure;
}

/// One at a time: from the scene as it is to the ends of each number.
BarChart MeasurePlots::effects() const {
  BarChart chart;
  chart.x.label = label_;
  chart.base = values_[0];
  chart.names = {"at its minimum", "at its maximum"};
  for (std::size_t j = 0; j < study_.vary.size(); ++j) {
    double smallest = kInfinity;
    double largest = -smallest;
    Bar at_smallest{kNaN, kNaN, kNaN};
    Bar at_largest = at_smallest;
    for (std::uint64_t point = 1; point < study_.points(); ++point) {
      if (levelsAt(study_.design, point)[j]) {
        const double x = study_.valuesAt(point)[j];
        if (x < smallest) {
          smallest = x;
          at_smallest.value = values_[point];
        }
        if (x > largest) {
          largest = x;
          at_largest.value = values_[point];
        }
      }
    }
    chart.groups.push_back({axisOf(study_.vary[j]), {at_smallest, at_largest}});
  }
  return chart;
}

std::optional<BarChart> MeasurePlots::tornado() const {
  BarChart chart;
  const auto add = [&](const std::vector<const std::vector<Estimate>*>& estimates) {
    for (std::size_t j = 0; j < study_.vary.size(); ++j) {
      BarGroup group{study_.vary[j].path, {}};
      for (const std::vector<Estimate>* of : estimates) {
        group.bars.push_back({(*of)[j].value, (*of)[j].low, (*of)[j].high});
      }
      chart.groups.push_back(group);
    }
  };
  if (!answers_.sobol.empty()) {
    const SobolIndices& indices = answers_.sobol[place_];
    chart.x.label = "Sobol indices: fractions of the variance";
    chart.names = {"total: with interactions", "first order: alone"};
    chart.subtitle = fmt::format("{} rows, 95 % intervals", indices.rows);
    add({&indices.total, &indices.first});
  } else if (!answers_.morris.empty()) {
    const MorrisEffects& effects = answers_.morris[place_];
    chart.x.label = nameWithUnit("change over the whole range of a parameter", measure_.unit);
    chart.names = {"mean magnitude", "standard deviation: nonlinear, or interactions"};
    chart.subtitle = fmt::format("Morris elementary effects, {} trajectories, 95 % intervals",
                                 effects.trajectories);
    add({&effects.mean_magnitude, &effects.deviation});
  } else if (study_.design.kind == Design::Kind::kOneAtATime && std::isfinite(values_[0])) {
    chart = effects();
    chart.subtitle = "one at a time, from the nominal scene";
  } else {
    return std::nullopt;
  }
  const auto weight = [&](const BarGroup& group) {
    double most = 0.0;
    for (std::size_t k = 0; k < group.bars.size(); ++k) {
      const bool counts = study_.design.kind == Design::Kind::kOneAtATime || k == 0;
      const double far = std::fabs(group.bars[k].value - chart.base);
      most = counts && std::isfinite(far) ? std::max(most, far) : most;
    }
    return most;
  };
  std::stable_sort(chart.groups.begin(), chart.groups.end(),
                   [&](const BarGroup& a, const BarGroup& b) { return weight(a) > weight(b); });
  if (chart.groups.size() > kMaxBars) {
    chart.subtitle +=
        fmt::format("; the {} most sensitive of {} parameters", kMaxBars, chart.groups.size());
    chart.groups.resize(kMaxBars);
  }
  chart.title = title_;
  return chart;
}

std::optional<ResponseMap> MeasurePlots::map() const {
  if (study_.design.kind != Design::Kind::kGrid || study_.vary.size() != 2 ||
      study_.design.levels[0] < 2 || study_.design.levels[1] < 2) {
    return std::nullopt;
  }
  ResponseMap map;
  map.title = title_;
  map.label = label_;
  map.x = {axisOf(study_.vary[0]), isLogarithmic(study_.vary[0])};
  map.y = {axisOf(study_.vary[1]), isLogarithmic(study_.vary[1])};
  // Lists need not rise.
  const auto sorted = [&](std::size_t number, std::vector<double>& levels) {
    const std::size_t count = study_.design.levels[number];
    const auto at = [&](std::size_t k) { return study_.vary[number].distribution.level(k, count); };
    std::vector<std::size_t> order(count);
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return at(a) < at(b); });
    for (const std::size_t k : order) {
      levels.push_back(at(k));
    }
    return order;
  };
  const std::vector<std::size_t> across = sorted(0, map.x_levels);
  const std::vector<std::size_t> down = sorted(1, map.y_levels);
  for (const std::size_t i : down) {
    map.values.emplace_back();
    for (const std::size_t k : across) {
      map.values.back().push_back(values_[k * down.size() + i]);  // the last varies fastest
    }
  }
  for (const Requirement& r : required_) {
    map.contours.push_back({r.limit, "limit of " + text(r, study_)});
  }
  return map;
}

}  // namespace

std::vector<StudyPlot> studyPlots(const Study& study, const StudyTable& table,
                                  const Answers& answers) {
  std::vector<StudyPlot> plots;
  for (std::size_t k = 0; k < study.measures.size(); ++k) {
    if (answers.measures[k].count == 0) {
      continue;
    }
    const MeasurePlots of(study, table, answers, k);
    const std::string& name = study.measures[k].name;
    plots.push_back({name, "histogram", figureJson(of.histogram())});
    plots.push_back({name, "scatter", figureJson(of.scatter())});
    if (const auto tornado = of.tornado()) {
      plots.push_back({name, "tornado", figureJson(*tornado)});
    }
    if (const auto map = of.map()) {
      plots.push_back({name, "map", figureJson(*map)});
    }
  }
  return plots;
}

}  // namespace whirl_twin
