// Every input of every model in each of its forms, with every method: the work of a zero-order-held
// input agrees with the audit, whatever the instants of its changes, and no step allocates.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "../models/every_variant.h"
#include "allocation_guard.h"
#include "integration/step_methods.h"

namespace whirl_twin {
namespace every_input_test {

struct Pair {
  VariantUnderTest variant;
  std::string method;
};

void PrintTo(const Pair& p, std::ostream* out) {
  *out << testName(p.variant) << " by " << p.method;
}

std::vector<Pair> everyPair() {
  std::vector<Pair> pairs;
  for (const VariantUnderTest& variant : everyVariant()) {
    for (const ModelVariant& v : findModel(variant.model)->variants) {
      if (v.when == variant.when && !v.inputs.empty()) {
        for (const std::string& method : integratorsOf(v)) {
          pairs.push_back({variant, method});
        }
      }
    }
  }
  return pairs;
}

class EveryInput : public testing::TestWithParam<Pair> {
 protected:
  ModelSetup setUp() const {
    const ModelInfo& model = *findModel(GetParam().variant.model);
    ParameterValues parameters;
    for (const ParameterInfo& p : model.parameters) {
      parameters[p.name] = choosesForm(p.name)              ? 0.0
                           : p.range == Range::kCount       ? 3.0
                           : p.name == "stiffness_coupling" ? 0.1
                                                            : 0.3;
    }
    for (const auto& [name, value] : GetParam().variant.parameters) {
      parameters[name] = value;
    }
    return model.setUp(parameters, GetParam().variant.settings, GetParam().variant.around(9.81));
  }

  /// Random values, changing at instants independent of the steps.
  InputSignal randomTable(bool hold) {
    std::vector<std::int64_t> instants{0};
    std::vector<double> values;
    while (instants.back() < 40'000'000) {
      values.push_back(std::uniform_real_distribution<double>(-1.0, 1.0)(random_));
      instants.push_back(instants.back() +
                         std::uniform_int_distribution<std::int64_t>(1, 3'000'000)(random_));
    }
    values.push_back(0.0);
    return InputSignal::table(instants, values, hold);
  }

  /// Difference between the gain of the Jacobi integral and the audited work after 32 ms, relative
  /// to the energy.
  double residual(const ModelSetup& setup, const Inputs& signals, std::int64_t step) {
    Inputs inputs = signals;
    Drive drive(3.0, 0.0);
    const double seconds = static_cast<double>(step) / 1e9;
    const auto system = setup.system(GetParam().method, {drive, &inputs}, seconds, 1);
    const auto n = setup.dynamics->dof();
    Eigen::VectorXd out(2 * n + 1);
    out.head(n).setConstant(0.5);
    out.segment(n, n).setConstant(0.1);
    system->set(Eigen::VectorXd(out.head(n)).data(), Eigen::VectorXd(out.segment(n, n)).data());
    const auto energies = [&](std::int64_t time) {
      const ShaftMotion shaft = drive.at(0.0);
      return setup.dynamics->energies(
          out.head(n), out.segment(n, n),
          {static_cast<double>(time) / 1e9, shaft.angle, shaft.speed, shaft.acceleration});
    };
    const Energies start = energies(0);
    const std::int64_t end = 32'000'000;
    for (std::int64_t time = 0; time < end; time += step) {
      drive.begin(time);
      inputs.begin(time);
      EXPECT_EQ(system->step(static_cast<double>(time) / 1e9), StepStatus::kOk);
    }
    drive.begin(end);
    system->write(out.data());
    const Energies now = energies(end);
    const double scale = std::max(std::abs(start.kinetic) + std::abs(start.potential),
                                  std::abs(now.kinetic) + std::abs(now.potential));
    return std::abs(now.jacobi - start.jacobi - out[2 * n]) / scale;
  }

  std::mt19937_64 random_{7};
};

TEST_P(EveryInput, OfHeldValuesClosesTheAudit) {
  const ModelSetup setup = setUp();
  std::vector<InputSignal> signals;
  for (std::size_t i = 0; i < setup.dynamics->inputs().size(); ++i) {
    signals.push_back(randomTable(true));
  }
  const Inputs inputs(signals);
  const std::int64_t step = 1'000'000;
  const double coarse = residual(setup, inputs, step);
  if (coarse > 1e-9) {
    // Truncation error of a low-order method: it falls with the order, from sub-steps that the
    // instants make shorter than a step anyway. A spin in the exact step of its rotor samples a
    // torque's jump at three nodes.
    const bool own_spin = setup.dynamics->isRotor() && !setup.dynamics->hasShaft() &&
                          GetParam().method == "exponential";
    const double order = own_spin ? 2.0 : stepMethod(GetParam().method).order;
    const double fine = residual(setup, inputs, step / 32);
    EXPECT_GT(order, 0.0);
    EXPECT_LT(fine, std::max(1e-9, coarse * std::pow(8.0, 0.5 - order)));
  }
}

TEST_P(EveryInput, AllocatesNothing) {
  const ModelSetup setup = setUp();
  const std::size_t count = setup.dynamics->inputs().size();
  for (std::size_t shift = 0; shift < 3; ++shift) {
    std::vector<InputSignal> signals;
    for (std::size_t i = 0; i < count; ++i) {
      signals.push_back((i + shift) % 3 == 0   ? InputSignal::constant(0.3)
                        : (i + shift) % 3 == 1 ? InputSignal::harmonic(0.3, 20.0, 1.0)
                                               : randomTable(shift == 0));
    }
    Inputs inputs(signals);
    const Drive drive(3.0, 0.0);
    const auto system = setup.system(GetParam().method, {drive, &inputs}, 1e-3, 1);
    const std::vector<double> state(2 * system->dof(), 0.3);
    system->set(state.data(), state.data() + system->dof());
    const AllocationGuard guard;
    for (std::int64_t step = 0; step < 70; ++step) {
      inputs.begin(step * 1'000'000);
      ASSERT_EQ(system->step(static_cast<double>(step) / 1e3), StepStatus::kOk);
    }
    EXPECT_EQ(guard.allocations(), 0u);
  }
}

INSTANTIATE_TEST_SUITE_P(Models, EveryInput, testing::ValuesIn(everyPair()), [](const auto& test) {
  return testName(test.param.variant) + "_" + test.param.method;
});

}  // namespace every_input_test
}  // namespace whirl_twin
