#include "twin/batched_members.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "algebra/constants.h"
#include "integration/batch_runge_kutta.h"
#include "integration/step_error_sum.h"
#include "models/batched_models.h"

namespace whirl_twin {

namespace {

/// From this number on a batch is faster than the systems' own steps.
constexpr std::size_t kFewest = 12;

std::vector<const Dynamics*> dynamicsOf(const std::vector<EnsembleMember>& members) {
  std::vector<const Dynamics*> all;
  for (const EnsembleMember& member : members) {
    all.push_back(member.setup.dynamics.get());
  }
  return all;
}

class BatchedMembers final : public EnsembleSteps {
 public:
  BatchedMembers(const std::vector<EnsembleMember>& members,
                 std::unique_ptr<BatchEquations> equations, const RungeKuttaTable& method,
                 const Drive& drive, double step)
      : drive_(drive),
        step_(step),
        steps_(std::move(equations), method, step, members.front().spec.substeps),
        sampled_(sampledMembers(members.size())),
        halves_(batchEquations(chosen(dynamicsOf(members), sampled_)), method, step,
                2 * members.front().spec.substeps),
        errors_(sampled_.size()),
        due_(sampled_.size()),
        start_rates_(sampled_.size(), std::vector<double>(steps_.dof())),
        q_(steps_.dof()),
        v_(steps_.dof()),
        finer_q_(steps_.dof()),
        finer_v_(steps_.dof()) {
    for (const EnsembleMember& member : members) {
      starts_.push_back({member.spec.q, member.spec.v});
    }
  }

  const char* description() const override { return "side by side in vectors"; }
  std::pair<double, double> speeds() const override {
    return {-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  }
  void reset() noexcept override {
    for (std::size_t i = 0; i < steps_.count(); ++i) {
      steps_.set(i, starts_[i].q.data(), starts_[i].v.data());
    }
    for (StepErrorSum& errors : errors_) {
      errors.restart();
    }
  }
  void exchange(StateImage& image) noexcept override { image(steps_, errors_); }
  void step(double time) noexcept override {
    bool any = false;
    for (std::size_t k = 0; k < sampled_.size(); ++k) {
      due_[k] = errors_[k].countStep() ? 1 : 0;
      any = any || due_[k] != 0;
    }
    for (std::size_t k = 0; any && k < sampled_.size(); ++k) {
      look(steps_, sampled_[k], q_, start_rates_[k]);
      halves_.set(k, q_.data(), start_rates_[k].data());
    }
    steps_.step(drive_, time);
    if (any) {
      halves_.step(drive_, time);
      for (std::size_t k = 0; k < sampled_.size(); ++k) {
        if (due_[k] != 0) {
          estimateError(k);
        }
      }
    }
  }
  void write(double* values, double* peaks) const noexcept override {
    const std::size_t n = steps_.dof();
    for (std::size_t i = 0; i < steps_.count(); ++i) {
      const bool stopped = steps_.stopped(i);
      for (std::size_t k = 0; k < n; ++k) {
        values[i * n + k] = stopped ? kNaN : steps_.q(i, k);
        peaks[i * n + k] = stopped ? kNaN : steps_.peak(i, k);
      }
    }
  }
  double errorSum() const noexcept override {
    double largest = 0.0;
    for (std::size_t k = 0; k < sampled_.size(); ++k) {
      if (!steps_.stopped(sampled_[k])) {
        largest = std::fmax(largest, errors_[k].sum());
      }
    }
    return largest;
  }

 private:
  struct Start {
    std::vector<double> q, v;
  };

  static std::vector<const Dynamics*> chosen(const std::vector<const Dynamics*>& all,
                                             const std::vector<std::size_t>& members) {
    std::vector<const Dynamics*> some;
    for (const std::size_t member : members) {
      some.push_back(all[member]);
    }
    return some;
  }
  static void look(const BatchRungeKutta& steps, std::size_t member, std::vector<double>& q,
                   std::vector<double>& v) noexcept {
    for (std::size_t i = 0; i < steps.dof(); ++i) {
      q[i] = steps.q(member, i);
      v[i] = steps.v(member, i);
    }
  }
  /// Adds the difference between the last step and its two half steps.
  void estimateError(std::size_t k) noexcept {
    if (steps_.stopped(sampled_[k]) || halves_.stopped(k)) {
      errors_[k].passOver();
      return;
    }
    look(steps_, sampled_[k], q_, v_);
    look(halves_, k, finer_q_, finer_v_);
    errors_[k].add(steps_.dof(), step_, start_rates_[k], q_, v_, finer_q_, finer_v_,
                   [this](std::size_t i) { return steps_.equations().angular(i); });
  }

  const Drive& drive_;
  double step_;  // [s]
  BatchRungeKutta steps_;
  std::vector<std::size_t> sampled_;              // members
  BatchRungeKutta halves_;                        // of these, with half the step
  std::vector<StepErrorSum> errors_;              // likewise
  std::vector<char> due_;                         // likewise: is this step checked?
  std::vector<std::vector<double>> start_rates_;  // likewise: before a checked step
  std::vector<Start> starts_;
  std::vector<double> q_, v_, finer_q_, finer_v_;  // work space for one sample
};

}  // namespace

std::unique_ptr<EnsembleSteps> batchedMembers(const std::vector<EnsembleMember>& members,
                                              const std::string& integrator,
                                              const StepContext& excitation, double step) {
  const RungeKuttaTable* const method = rungeKuttaTable(integrator);
  if (method == nullptr || excitation.inputs != nullptr || members.size() < kFewest) {
    return nullptr;
  }
  auto equations = batchEquations(dynamicsOf(members));
  if (!equations) {
    return nullptr;
  }
  return std::make_unique<BatchedMembers>(members, std::move(equations), *method, excitation.drive,
                                          step);
}

}  // namespace whirl_twin
