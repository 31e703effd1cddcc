// Makes a ControllerInfo of a control law that is a struct:
//
//   struct MyLaw {
//     static constexpr const char* kName = "my_law";
//     static constexpr const char* kSummary = "a line for `twin controllers`";
//     double gain = 0.0;
//     static constexpr std::array<Parameter<MyLaw>, 1> parameters();   // as a model's
//     void prepare(const ControllerPlan& plan);                        // optional
//     void reset(const ControllerPlan& plan) noexcept;
//     void update(const ControlSample& sample, double* outputs) noexcept;
//     void takeOver(const MyLaw& before) noexcept;                     // optional
//     void exchange(StateImage& image) noexcept;                       // of a law that owns memory
//     DiscreteStateSpace linear(double shaft_speed) const;             // optional
//     std::vector<double> setpoint() const;                            // optional
//   };
//
// prepare() is called once, with its parameters set and before all else: it allocates, and throws
// SetupError for what does not fit. reset(), update(), takeOver() and exchange() are real-time safe
// (controllers/controller.h). A law that owns memory (a vector), and has no exchange()
// (realtime/state_image.h) prevents checkpoints of its twin.
#pragma once

#include <memory>
#include <optional>
#include <type_traits>
#include <utility>
#include <vector>

#include "controllers/controller_info.h"
#include "integration/finite.h"
#include "mechanics/model_description.h"

namespace whirl_twin {

template <class Law, class = void>
struct HasPrepare : std::false_type {};
template <class Law>
struct HasPrepare<Law, std::void_t<decltype(&Law::prepare)>> : std::true_type {};

template <class Law, class = void>
struct HasTakeOver : std::false_type {};
template <class Law>
struct HasTakeOver<Law, std::void_t<decltype(&Law::takeOver)>> : std::true_type {};

template <class Law, class = void>
struct HasLinear : std::false_type {};
template <class Law>
struct HasLinear<Law, std::void_t<decltype(&Law::linear)>> : std::true_type {};

template <class Law, class = void>
struct HasSetpoint : std::false_type {};
template <class Law>
struct HasSetpoint<Law, std::void_t<decltype(&Law::setpoint)>> : std::true_type {};

/// Adapts a control law that is a struct to the Controller interface.
template <class Law>
class LawController final : public Controller {
  static_assert(
      noexcept(std::declval<Law&>().reset(std::declval<const ControllerPlan&>())) && noexcept(
          std::declval<Law&>().update(std::declval<const ControlSample&>(), nullptr)),
      "reset() and update() run in the real-time loop: they are to be noexcept");

 public:
  LawController(Law law, ControllerPlan plan) : law_(std::move(law)), plan_(std::move(plan)) {
    if constexpr (HasPrepare<Law>::value) {
      law_.prepare(plan_);
    }
    law_.reset(plan_);
  }

  void reset() noexcept override { law_.reset(plan_); }
  void update(const ControlSample& sample, double* outputs) noexcept override {
    law_.update(sample, outputs);
  }
  void takeOver([[maybe_unused]] const Controller& before) noexcept override {
    if constexpr (HasTakeOver<Law>::value) {
      static_assert(noexcept(std::declval<Law&>().takeOver(std::declval<const Law&>())),
                    "takeOver() runs in the real-time loop: it is to be noexcept");
      if (const auto* const same = dynamic_cast<const LawController*>(&before)) {
        law_.takeOver(same->law_);
      }
    }
  }
  void exchange(StateImage& image) noexcept override {
    if constexpr (Exchanges<Law>::value || std::is_trivially_destructible_v<Law>) {
      image(law_);
    } else {
      image.refuse();
    }
  }
  std::optional<DiscreteStateSpace> linear([[maybe_unused]] double shaft_speed) const override {
    if constexpr (HasLinear<Law>::value) {
      return law_.linear(shaft_speed);
    } else {
      return std::nullopt;
    }
  }
  std::vector<double> setpoint() const override {
    if constexpr (HasSetpoint<Law>::value) {
      return law_.setpoint();
    } else {
      return {};
    }
  }

 private:
  Law law_;
  ControllerPlan plan_;
};

template <class Law>
ControllerInfo controllerInfo() {
  ControllerInfo info;
  info.name = Law::kName;
  info.summary = Law::kSummary;
  for (const auto& p : Law::parameters()) {
    info.parameters.push_back(
        {p.name, p.unit, p.range, p.meaning,
         isFinite(p.fallback) ? std::optional<double>(p.fallback) : std::nullopt,
         p.fallback_parameter == nullptr ? "" : p.fallback_parameter});
  }
  info.make = [](const ParameterValues& values, const Settings&, const ControllerPlan& plan) {
    Law law{};
    for (const auto& p : Law::parameters()) {
      law.*p.member = values.at(p.name);
    }
    return std::make_unique<LawController<Law>>(std::move(law), plan);
  };
  return info;
}

}  // namespace whirl_twin
