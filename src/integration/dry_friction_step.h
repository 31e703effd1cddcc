// A step of a system with dry friction (mechanics/dry_friction.h): divided into sub-steps in which
// every contact slides in one direction or sticks, so that the equations of a sub-step are smooth
// and a method keeps its order.
//
// A sub-step ends where a sliding contact comes to rest or the friction of a sticking one is
// exhausted; that event is located by false position (the Illinois rule, Dahlquist & Bjoerck,
// Numerical Methods, 6.4.3) over steps of the method from the start of the sub-step, to rounding. A
// sliding speed that crosses zero twice within a sub-step is detected by the cubic through its
// ends. Which contacts slide depends on the state alone: the only information from earlier steps is
// whether a method's history belongs to the same equations.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "integration/erased_ode.h"
#include "integration/motion_state.h"
#include "integration/sliver.h"
#include "mechanics/dry_friction.h"

namespace whirl_twin {

template <std::size_t n>
class DryFrictionStep {
 public:
  /// Discards the history: the next step does not use the one before.
  void restart() { has_past_ = false; }
  /// Whether the step before had no event.
  bool hasPast() const { return has_past_; }

  /// Advances a state by one step of h [s] of a method; `past`: with the method's history. A
  /// type-erased reference, so that the caller is compiled once for all methods.
  class Advance {
   public:
    template <class F>
    explicit Advance(const F& f)
        : f_(&f),
          call_([](const void* self, const ErasedOde<n>& equation, double offset, double h,
                   MotionState<n>& state, bool past) {
            return (*static_cast<const F*>(self))(equation, offset, h, state, past);
          }) {}
    StepStatus operator()(const ErasedOde<n>& equation, double offset, double h,
                          MotionState<n>& state, bool past) const {
      return call_(f_, equation, offset, h, state, past);
    }

   private:
    const void* f_;
    StepStatus (*call_)(const void*, const ErasedOde<n>&, double, double, MotionState<n>&, bool);
  };

  [[gnu::noinline]] StepStatus take(ErasedOde<n> equation, double offset, double h,
                                    MotionState<n>& state, const Advance& advance) noexcept {
    const double end = offset + h;
    bool past = has_past_;
    has_past_ = false;
    for (int part = 0; part < kMaxParts; ++part) {
      const DryState<n> dry = equation.dryStateAt(state.q, state.v, offset);
      equation.dry = &dry;
      past = past && dry.held == last_.held && slides(dry) == slides(last_);
      last_ = dry;
      const Start start{state, offset, end - offset};
      MotionState<n> whole = state;
      StepStatus status = advance(equation, offset, start.length, whole, past);
      if (status != StepStatus::kOk) {
        return status;
      }
      past = false;
      const double passed = firstEvent(equation, start, dry, whole, advance, status);
      if (status != StepStatus::kOk) {
        return status;
      }
      state = whole;
      stop(equation.model.dryContacts(), dry.held, state);
      if (passed >= 1.0) {
        has_past_ = part == 0;
        return StepStatus::kOk;
      }
      offset += passed * start.length;
      if (end - offset <= kSliver * h) {
        return StepStatus::kOk;
      }
    }
    return StepStatus::kNotConverged;
  }

 private:
  struct Start {
    MotionState<n> state;
    double offset, length;  // [s]
  };

  static constexpr int kMaxParts = 64;
  static constexpr int kMaxTrials = 80;
  static constexpr double kAtOnce = 1.0e-9;     ///< closer events are merged
  static constexpr double kRounding = 1.0e-15;  ///< of the event function, relative to its size in
                                                ///< the step

  /// The directions of the sliding contacts.
  static ContactNumbers slides(const DryState<n>& dry) {
    ContactNumbers share{};
    for (std::size_t j = 0; j < kMaxContacts; ++j) {
      share[j] = dry.held[j] ? 0.0 : dry.share[j];
    }
    return share;
  }

  /// Event functions of the contacts: the speed of a sliding contact, the unused share of friction
  /// of a sticking one.
  ContactNumbers left(const ErasedOde<n>& equation, double offset,
                      const MotionState<n>& state) const {
    const DryContacts<n>& contacts = equation.model.dryContacts();
    const DryState<n>& dry = *equation.dry;
    ContactNumbers left{};
    ContactNumbers share{};
    if (dry.holdsAny()) {
      share = equation.sharesAt(state.q, state.v, offset);
    }
    for (std::size_t j = 0; j < contacts.count; ++j) {
      left[j] =
          dry.held[j] ? 1.0 - std::fabs(share[j]) : dry.share[j] * contacts.at[j].sliding(state.v);
    }
    return left;
  }

  /// The fraction of the step after which the first contact changes, 1 without any; `found` is the
  /// state then.
  double firstEvent(const ErasedOde<n>& equation, const Start& start, const DryState<n>& dry,
                    MotionState<n>& found, const Advance& advance, StepStatus& status) const {
    const DryContacts<n>& contacts = equation.model.dryContacts();
    const ContactNumbers at_start = left(equation, start.offset, start.state);
    const ContactNumbers at_end = left(equation, start.offset + start.length, found);
    ContactNumbers scale{1.0, 1.0};
    for (std::size_t j = 0; j < contacts.count; ++j) {
      scale[j] = std::max({std::fabs(at_start[j]), std::fabs(at_end[j]), 1.0e-300});
    }
    // The smallest event function of any contact, at a fraction of the step.
    const auto leastOf = [&](const ContactNumbers& of) {
      double least = 1.0;
      for (std::size_t j = 0; j < contacts.count; ++j) {
        least = std::min(least, of[j] / scale[j]);
      }
      return least;
    };
    MotionState<n> trial;
    const auto leastAt = [&](double part) {
      trial = start.state;
      status = advance(equation, start.offset, part * start.length, trial, false);
      return status == StepStatus::kOk
                 ? leastOf(left(equation, start.offset + part * start.length, trial))
                 : 0.0;
    };
    double high = 1.0;
    double at_high = leastOf(at_end);
    if (at_high > 0.0) {
      high = lowestDip(equation, start, dry, found);
      if (high >= 1.0) {
        return 1.0;
      }
      at_high = leastAt(high);
      if (status != StepStatus::kOk || at_high > 0.0) {
        return 1.0;
      }
      found = trial;
    }
    double low = 0.0;
    double at_low = leastOf(at_start);
    for (int i = 0; at_low <= 0.0 && i < kMaxTrials / 2; ++i) {  // it has just begun to slide
      const double part = 0.5 * high;
      const double least = leastAt(part);
      if (status != StepStatus::kOk) {
        return 1.0;
      }
      if (least > 0.0) {
        low = part;
        at_low = least;
      } else {
        high = part;
        at_high = least;
        found = trial;
      }
    }
    double reached = at_high;
    for (int i = 0;
         i < kMaxTrials && at_low > 0.0 && reached < -kRounding && high - low > kSliver * high;
         ++i) {
      const double guess = low + (high - low) * at_low / (at_low - at_high);
      const double part = guess > low && guess < high ? guess : 0.5 * (low + high);
      const double least = leastAt(part);
      if (status != StepStatus::kOk) {
        return 1.0;
      }
      if (least > 0.0) {
        low = part;
        at_low = least;
        at_high *= 0.5;
      } else {
        high = part;
        at_high = least;
        at_low *= 0.5;
        reached = least;
        found = trial;
      }
    }
    // A contact that has come to rest sticks from here on, or reverses.
    const ContactNumbers now = left(equation, start.offset + high * start.length, found);
    std::array<bool, kMaxContacts> rests = dry.held;
    for (std::size_t j = 0; j < contacts.count; ++j) {
      rests[j] = dry.held[j] || now[j] <= kAtOnce * scale[j];
    }
    stop(contacts, rests, found);
    return high;
  }

  /// Where in the step the speed of a sliding contact is lowest below zero although it is not so at
  /// the ends, by the cubic through them; 1: nowhere.
  double lowestDip(const ErasedOde<n>& equation, const Start& start, const DryState<n>& dry,
                   const MotionState<n>& end) const {
    const DryContacts<n>& contacts = equation.model.dryContacts();
    double where = 1.0;
    double lowest = -kRounding;
    if ((contacts.count < 1 || dry.held[0]) && (contacts.count < 2 || dry.held[1])) {
      return where;
    }
    const auto before = equation(start.state.q, start.state.v, start.offset).acceleration;
    const auto after = equation(end.q, end.v, start.offset + start.length).acceleration;
    for (std::size_t j = 0; j < contacts.count; ++j) {
      if (dry.held[j]) {
        continue;
      }
      const DryContact<n>& contact = contacts.at[j];
      double slope0 = 0.0;
      double slope1 = 0.0;
      for (std::size_t i = 0; i < n; ++i) {
        slope0 += dry.share[j] * start.length * contact.direction[i] * before[i];
        slope1 += dry.share[j] * start.length * contact.direction[i] * after[i];
      }
      const double w0 = dry.share[j] * contact.sliding(start.state.v);
      const double w1 = dry.share[j] * contact.sliding(end.v);
      if (!(w0 > 0.0 && slope0 < 0.0 && slope1 > 0.0)) {
        continue;
      }
      // w0 + slope0 x + b x^2 + c x^3, least where its slope is zero on the rising side.
      const double b = 3.0 * (w1 - w0) - 2.0 * slope0 - slope1;
      const double c = slope0 + slope1 - 2.0 * (w1 - w0);
      const double root = std::sqrt(std::max(0.0, b * b - 3.0 * c * slope0));
      const double x = b + root != 0.0 ? -slope0 / (b + root) : 1.0;
      const double w = w0 + x * (slope0 + x * (b + x * c));
      if (x > 0.0 && x < 1.0 && w / (w0 + w1) < lowest) {
        lowest = w / (w0 + w1);
        where = x;
      }
    }
    return where;
  }

  /// Contacts that are at rest do not slide, not even by rounding.
  static void stop(const DryContacts<n>& contacts, const std::array<bool, kMaxContacts>& rests,
                   MotionState<n>& state) {
    // Twice, as the second contact may move what the first has stopped.
    for (int round = 0; round < 2; ++round) {
      for (std::size_t j = 0; j < contacts.count; ++j) {
        if (!rests[j]) {
          continue;
        }
        const std::array<double, n> g = across(contacts, rests, j);
        double w = -contacts.at[j].speed;
        double along = 0.0;
        for (std::size_t i = 0; i < n; ++i) {
          w += contacts.at[j].direction[i] * state.v[i];
          along += contacts.at[j].direction[i] * g[i];
        }
        for (std::size_t i = 0; i < n; ++i) {
          if (g[i] != 0.0) {
            state.v[i] -= w * g[i] / along;
            state.v_low[i] = 0.0;
          }
        }
      }
    }
  }
  /// The direction of a contact, orthogonal to that of the other if that sticks too: a change of
  /// rates along it keeps the other sticking.
  static std::array<double, n> across(const DryContacts<n>& contacts,
                                      const std::array<bool, kMaxContacts>& rests, std::size_t j) {
    std::array<double, n> g = contacts.at[j].direction;
    const std::size_t k = 1 - j;
    if (!rests[k]) {
      return g;
    }
    const std::array<double, n>& other = contacts.at[k].direction;
    double product = 0.0;
    double square = 0.0;
    for (std::size_t i = 0; i < n; ++i) {
      product += g[i] * other[i];
      square += other[i] * other[i];
    }
    for (std::size_t i = 0; i < n; ++i) {
      g[i] -= product / square * other[i];
    }
    return g;
  }

  DryState<n> last_;
  bool has_past_ = false;
};

/// In place of one, in systems that are composed with their model and do not stick.
struct NoDryFriction {
  void restart() {}
};

}  // namespace whirl_twin
