#include "scene/system_setup.h"

#include <algorithm>
#include <stdexcept>

#include "models/model_registry.h"

namespace whirl_twin {

namespace {

// Structured bindings list every field: the compiler reports a later addition.

bool same(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  return a.rows() == b.rows() && a.cols() == b.cols() && a == b;
}

bool same(const TableRow& a, const TableRow& b) {
  const auto& [numbers, words, following] = a;
  return numbers == b.numbers && words == b.words && following == b.following;
}

template <class Value>
bool same(const std::vector<Value>& a, const std::vector<Value>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const Value& x, const Value& y) { return same(x, y); });
}

template <class Value>
bool same(const std::map<std::string, Value>& a, const std::map<std::string, Value>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const auto& x, const auto& y) {
    return x.first == y.first && same(x.second, y.second);
  });
}

bool same(const Settings& a, const Settings& b) {
  const auto& [choices, matrices, names, tables] = a;
  return choices == b.choices && names == b.names && same(matrices, b.matrices) &&
         same(tables, b.tables);
}

bool same(const Motor& a, const Motor& b) {
  const auto& [points, count, extended, drag] = a;
  return std::equal(points.begin(), points.end(), b.points.begin(),
                    [](const MotorPoint& x, const MotorPoint& y) {
                      const auto& [speed, torque] = x;
                      return speed == y.speed && torque == y.torque;
                    }) &&
         count == b.count && extended == b.extended && drag == b.drag;
}

bool same(const ModelContext& a, const ModelContext& b) {
  const auto& [gravity, motor] = a;
  return gravity == b.gravity && motor.has_value() == b.motor.has_value() &&
         (!motor || same(*motor, *b.motor));
}

}  // namespace

std::shared_ptr<const SystemSetup> setUp(const ModelInfo& model, const SystemSpec& spec,
                                         const ModelContext& around) {
  return std::make_shared<const SystemSetup>(
      SystemSetup{&model, spec.parameters, spec.settings, around,
                  model.setUp(spec.parameters, spec.settings, around)});
}

const SystemSetup& setupOf(SystemSpec& spec, const ModelContext& around) {
  const SystemSetup* const known = spec.setup.get();
  if (known == nullptr || known->model->name != spec.model ||
      known->parameters != spec.parameters || !same(known->settings, spec.settings) ||
      !same(known->around, around)) {
    const ModelInfo* const model = findModel(spec.model);
    if (model == nullptr) {
      throw std::logic_error("no model named " + spec.model);
    }
    spec.setup = setUp(*model, spec, around);
  }
  return *spec.setup;
}

}  // namespace whirl_twin
