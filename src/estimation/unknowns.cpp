#include "estimation/unknowns.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "scene/input_reader.h"

namespace whirl_twin {

namespace {

constexpr double kNoBound = std::numeric_limits<double>::infinity();
constexpr double kLeastOfPositive = 1.0e-6;  // of the start: a positive number is not 0
constexpr double kLeastScale = 1.0e-3;
constexpr double kLongestDelay = 1.0;  // s

void addOnce(std::vector<Unknown>& all, Unknown unknown) {
  const bool known = std::any_of(all.begin(), all.end(), [&](const Unknown& u) {
    return u.kind == unknown.kind && u.subject == unknown.subject;
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
        u.least = std::max(u.least, kLeastOfPositive * fitted.start);
      } else if (parameter.range == Range::kNotNegative) {
        u.least = std::max(u.least, 0.0);
      }
    }
  }
  return u;
}

void addSensors(const StudyRun& run, std::vector<Unknown>& all) {
  for (const MeasuredChannel& c : run.measured) {
    if (c.offset.fitted) {
      addOnce(all, {Unknown::Kind::kChannelOffset, c.name, c.name + ".offset", c.unit,
                    c.offset.value, -kNoBound, kNoBound});
    }
    if (c.scale.fitted) {
      addOnce(all, {Unknown::Kind::kChannelScale, c.name, c.name + ".scale", "-", c.scale.value,
                    kLeastScale, kNoBound});
    }
  }
  for (const MeasuredInput& i : run.inputs) {
    if (i.offset.fitted) {
      addOnce(all, {Unknown::Kind::kInputOffset, i.name, i.name + ".offset", "", i.offset.value,
                    -kNoBound, kNoBound});
    }
    if (i.scale.fitted) {
      addOnce(all, {Unknown::Kind::kInputScale, i.name, i.name + ".scale", "-", i.scale.value,
                    kLeastScale, kNoBound});
    }
    if (i.delay.fitted) {
      addOnce(all, {Unknown::Kind::kInputDelay, i.name, i.name + ".delay", "s", i.delay.value,
                    -kLongestDelay, kLongestDelay});
    }
  }
}

template <class Column>
void takeValue(std::vector<Column>& columns, const std::string& name, GivenOrFitted Column::*which,
               double value) {
  for (Column& column : columns) {
    if (column.name == name && (column.*which).fitted) {
      (column.*which).value = value;
    }
  }
}

void take(std::vector<StudyRun>& runs, const Unknown& unknown, double value) {
  for (StudyRun& run : runs) {
    switch (unknown.kind) {
      case Unknown::Kind::kParameter:
        break;
      case Unknown::Kind::kChannelOffset:
        takeValue(run.measured, unknown.subject, &MeasuredChannel::offset, value);
        break;
      case Unknown::Kind::kChannelScale:
        takeValue(run.measured, unknown.subject, &MeasuredChannel::scale, value);
        break;
      case Unknown::Kind::kInputOffset:
        takeValue(run.inputs, unknown.subject, &MeasuredInput::offset, value);
        break;
      case Unknown::Kind::kInputScale:
        takeValue(run.inputs, unknown.subject, &MeasuredInput::scale, value);
        break;
      case Unknown::Kind::kInputDelay:
        takeValue(run.inputs, unknown.subject, &MeasuredInput::delay, value);
        break;
    }
  }
}

InputSignal signalOf(const MeasuredRun& data, const MeasuredInput& input) {
  const std::vector<double>& column = data.column(input.column);
  std::vector<std::int64_t> instants;
  std::vector<double> values;
  for (std::size_t i = 0; i < column.size(); ++i) {
    const std::int64_t at = std::llround((data.time[i] + input.delay.value) * 1.0e9);
    if (instants.empty() || at > instants.back()) {  // rows nearer than a nanosecond are one
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
  for (const StudyRun& run : study.runs) {
    if (run.train) {
      addSensors(run, all);
    }
  }
  return all;
}

CandidateMaker::CandidateMaker(const FitStudy& study)
    : study_(study),
      scene_(build(study.scene)),
      unknowns_(unknownsOf(study, scene_.systems.front())) {}

Candidate CandidateMaker::at(const Eigen::VectorXd& theta) const {
  Candidate candidate;
  std::vector<std::string> paths;
  std::vector<double> values;
  for (const StudyRun& run : study_.runs) {
    candidate.runs.push_back({run.file, run.train, run.measured, run.inputs, {}});
  }
  for (std::size_t i = 0; i < unknowns_.size(); ++i) {
    const double value = theta[static_cast<Eigen::Index>(i)];
    if (unknowns_[i].kind == Unknown::Kind::kParameter) {
      paths.push_back(unknowns_[i].subject);
      values.push_back(value);
    } else {
      take(candidate.runs, unknowns_[i], value);
    }
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
