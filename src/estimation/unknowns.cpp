#include "estimation/unknowns.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "scene/input_reader.h"

namespace whirl_twin {

namespace {

constexpr double kNoBound = std::numeric_limits<double>::infinity();
constexpr double kMinOfPositive = 1.0e-6;  // relative to the start: a positive number is not 0
constexpr double kMinScale = 1.0e-3;

void addOnce(std::vector<Unknown>& all, Unknown unknown) {
  const bool known = std::any_of(all.begin(), all.end(), [&](const Unknown& u) {
    return u.kind == unknown.kind && u.subject == unknown.subject && u.run == unknown.run;
  });
  if (!known) {
    all.push_back(std::move(unknown));
  }
}

Unknown parameterUnknown(const FittedParameter& fitted, const ModelInfo& model) {
  Unknown u{Unknown::Kind::kParameter,
            fitted.path,
            fitted.path,
            "",
            fitted.start,
            fitted.least,
            fitted.most};
  for (const ParameterInfo& parameter : model.parameters) {
    if (parameter.name == fitted.path) {
      u.unit = parameter.unit;
      if (parameter.range == Range::kPositive) {
        u.least = std::max(u.least, kMinOfPositive * fitted.start);
      } else if (parameter.range == Range::kNotNegative) {
        u.least = std::max(u.least, 0.0);
      }
    }
  }
  return u;
}

/// A number of a sensor; name and subject without the run.
struct SensorNumber {
  const GivenOrFitted& number;
  Unknown unknown;
};

std::vector<SensorNumber> numbersOf(const StudyRun& run) {
  std::vector<SensorNumber> all;
  for (const MeasuredChannel& c : run.measured) {
    all.push_back({c.offset,
                   {Unknown::Kind::kChannelOffset, c.name, c.name + ".offset", c.unit,
                    c.offset.value, -kNoBound, kNoBound}});
    all.push_back({c.scale,
                   {Unknown::Kind::kChannelScale, c.name, c.name + ".scale", "-", c.scale.value,
                    kMinScale, kNoBound}});
  }
  for (const MeasuredInput& i : run.inputs) {
    all.push_back({i.offset,
                   {Unknown::Kind::kInputOffset, i.name, i.name + ".offset", "", i.offset.value,
                    -kNoBound, kNoBound}});
    all.push_back({i.scale,
                   {Unknown::Kind::kInputScale, i.name, i.name + ".scale", "-", i.scale.value,
                    kMinScale, kNoBound}});
    all.push_back({i.delay,
                   {Unknown::Kind::kInputDelay, i.name, i.name + ".delay", "s", i.delay.value,
                    -kMaxInputDelay, kMaxInputDelay}});
  }
  return all;
}

void addSensors(const FitStudy& study, std::size_t r, bool shared, std::vector<Unknown>& all) {
  for (SensorNumber& one : numbersOf(study.runs[r])) {
    if (!one.number.fitted || !(shared || one.number.each_run)) {
      continue;
    }
    if (one.number.each_run) {
      one.unknown.run = r;
      one.unknown.name += " of " + study.runs[r].file;
    }
    addOnce(all, std::move(one.unknown));
  }
}

template <class Column>
void takeValue(std::vector<Column>& columns, const Unknown& unknown, GivenOrFitted Column::*which,
               double value) {
  for (Column& column : columns) {
    GivenOrFitted& number = column.*which;
    if (column.name == unknown.subject && number.fitted &&
        number.each_run == unknown.run.has_value()) {
      number.value = value;
    }
  }
}

void take(StudyRun& run, const Unknown& unknown, double value) {
  switch (unknown.kind) {
    case Unknown::Kind::kParameter:
      break;
    case Unknown::Kind::kChannelOffset:
      takeValue(run.measured, unknown, &MeasuredChannel::offset, value);
      break;
    case Unknown::Kind::kChannelScale:
      takeValue(run.measured, unknown, &MeasuredChannel::scale, value);
      break;
    case Unknown::Kind::kInputOffset:
      takeValue(run.inputs, unknown, &MeasuredInput::offset, value);
      break;
    case Unknown::Kind::kInputScale:
      takeValue(run.inputs, unknown, &MeasuredInput::scale, value);
      break;
    case Unknown::Kind::kInputDelay:
      takeValue(run.inputs, unknown, &MeasuredInput::delay, value);
      break;
  }
}

InputSignal signalOf(const MeasuredRun& data, const MeasuredInput& input) {
  const std::vector<double>& column = data.column(input.column);
  std::vector<std::int64_t> instants;
  std::vector<double> values;
  for (std::size_t i = 0; i < column.size(); ++i) {
    const std::int64_t at = std::llround((data.time[i] + input.delay.value) * 1.0e9);
    if (instants.empty() || at > instants.back()) {  // rows closer than a nanosecond are merged
      instants.push_back(at);
      values.push_back(input.scale.value * column[i] + input.offset.value);
    }
  }
  return InputSignal::table(std::move(instants), std::move(values), input.hold);
}

}  // namespace

std::vector<Unknown> unknownsOf(const FitStudy& study, const SharedSystem& system) {
  std::vector<Unknown> all;
  if (study.validate_only) {
    return all;
  }
  for (const FittedParameter& fitted : study.fit) {
    all.push_back(parameterUnknown(fitted, *system->model));
  }
  for (std::size_t r = 0; r < study.runs.size(); ++r) {
    if (study.runs[r].train) {
      addSensors(study, r, true, all);
    }
  }
  return all;
}

CandidateMaker::CandidateMaker(const FitStudy& study)
    : study_(study),
      scene_(build(study.scene)),
      unknowns_(unknownsOf(study, scene_.systems.front())) {}

CandidateMaker CandidateMaker::ofRun(std::size_t run, const Eigen::VectorXd& theta) const {
  CandidateMaker own = *this;
  own.known_ = unknowns_;
  own.known_values_ = theta;
  own.unknowns_.clear();
  addSensors(study_, run, false, own.unknowns_);
  return own;
}

Candidate CandidateMaker::at(const Eigen::VectorXd& theta) const {
  Candidate candidate;
  std::vector<std::string> paths;
  std::vector<double> values;
  for (const StudyRun& run : study_.runs) {
    candidate.runs.push_back({run.file, run.train, run.measured, run.inputs, {}});
  }
  const auto apply = [&](const Unknown& unknown, double value) {
    if (unknown.kind == Unknown::Kind::kParameter) {
      paths.push_back(unknown.subject);
      values.push_back(value);
    }
    for (std::size_t r = 0; r < candidate.runs.size(); ++r) {
      if (unknown.concerns(r)) {
        take(candidate.runs[r], unknown, value);
      }
    }
  };
  for (std::size_t i = 0; i < known_.size(); ++i) {
    apply(known_[i], known_values_[static_cast<Eigen::Index>(i)]);
  }
  for (std::size_t i = 0; i < unknowns_.size(); ++i) {
    apply(unknowns_[i], theta[static_cast<Eigen::Index>(i)]);
  }
  const SharedSystem& base = scene_.systems.front();
  candidate.system = paths.empty() ? base : base->with(paths, values, study_.source);
  const std::vector<InputInfo> inputs = candidate.system->dynamics->inputs();
  for (std::size_t r = 0; r < study_.runs.size(); ++r) {
    std::map<std::string, InputSignal> signals = study_.spec().inputs;
    for (const MeasuredInput& input : candidate.runs[r].inputs) {
      signals[input.name] = signalOf(study_.runs[r].data, input);
    }
    candidate.inputs.push_back(signalsOf(inputs, signals));
  }
  return candidate;
}

}  // namespace whirl_twin
