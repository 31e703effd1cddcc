// Dry (Coulomb) friction where two parts touch: it opposes sliding with a force of constant level,
// and without sliding it has any value up to that level (sticking).
//
//   Q = -s L G,   s = sign(w) while it slides,   |s| <= 1 while it is held,   w = G . v - u
//
// L is the level, G the direction, u the speed of a moving counterpart, s the share of the friction
// that acts (C. Glocker, Set-Valued Force Laws, Springer 2001, ch. 5). A contact sticks with the
// share for which w' = 0; it begins to slide where that share would have to exceed 1. The steps
// locate start and end of sliding as events (integration/dry_friction_step.h). A width of more than
// 0 regularizes the law instead, s = w / sqrt(w^2 + width^2): a contact that would stick then
// creeps.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <type_traits>
#include <utility>

#include "mechanics/evaluation_point.h"
#include "mechanics/lagrangian.h"

namespace whirl_twin {

inline constexpr std::size_t kMaxContacts = 2;

/// A number for each contact of a model; what is beyond them is 0.
using ContactNumbers = std::array<double, kMaxContacts>;

template <std::size_t n>
struct DryContact {
  const char* place = "";             ///< "at the pivot"
  const char* unit = "";              ///< of the level: "N m", "N", "-"
  std::array<double, n> direction{};  ///< G
  double level = 0.0;                 ///< L
  double speed = 0.0;                 ///< u [rad/s] or [m/s]

  /// w [rad/s] or [m/s], as computed.
  double computedSliding(const std::array<double, n>& v) const {
    double w = -speed;
    for (std::size_t i = 0; i < n; ++i) {
      w += direction[i] * v[i];
    }
    return w;
  }
  /// w; 0 where it is no more than rounding, also of the other rates.
  double sliding(const std::array<double, n>& v) const {
    double size = std::fabs(speed);
    for (std::size_t i = 0; i < n; ++i) {
      size += std::fabs(v[i]);
    }
    const double w = computedSliding(v);
    return std::fabs(w) <= 16.0 * 2.2e-16 * size ? 0.0 : w;
  }
};

/// The contacts of a model whose friction is not rounded off.
template <std::size_t n>
struct DryContacts {
  std::size_t count = 0;
  std::array<DryContact<n>, kMaxContacts> at{};

  /// Without friction, or with one that is rounded off within a width, it is none.
  void add(const DryContact<n>& contact, double width) {
    if (contact.level > 0.0 && width == 0.0) {
      at[count++] = contact;
    }
  }
  /// The shares where every contact slides, 0 for one that does not.
  ContactNumbers slidingShares(const std::array<double, n>& v) const {
    ContactNumbers share{};
    for (std::size_t j = 0; j < count; ++j) {
      share[j] = sign(at[j].sliding(v));
    }
    return share;
  }
  /// The shares that are in the model's equations: of the signs of the computed w.
  ContactNumbers computedShares(const std::array<double, n>& v) const {
    ContactNumbers share{};
    for (std::size_t j = 0; j < count; ++j) {
      share[j] = sign(at[j].computedSliding(v));
    }
    return share;
  }
  static double sign(double w) { return w > 0.0 ? 1.0 : w < 0.0 ? -1.0 : 0.0; }
};

/// Of a contact: the energy lost per time of a level L and a sliding speed w, whose slope by w is
/// the friction; for the D of a model. Without a width it is in the equations as at the computed
/// sign of w; the steps put the share in its place that acts.
template <class S>
WHIRL_TWIN_INLINE S dryDissipation(double level, double width, const S& w) {
  if (width > 0.0) {
    return level * sqrt(w * w + width * width);
  }
  return w > 0.0 ? level * w : w < 0.0 ? -level * w : 0.0 * w;
}

/// A model with dry friction defines its contacts: dryContacts().
template <class Model, class = void>
struct HasDryContacts : std::false_type {
  static DryContacts<Model::kDof> of(const Model&) { return {}; }
};
template <class Model>
struct HasDryContacts<Model, std::void_t<decltype(std::declval<const Model&>().dryContacts())>>
    : std::true_type {
  static DryContacts<Model::kDof> of(const Model& model) { return model.dryContacts(); }
};

/// A model with state-dependent friction defines it: dryFriction(q, share).
template <class Model, class = void>
struct HasFrictionOfState : std::false_type {};
template <class Model>
struct HasFrictionOfState<Model, std::void_t<decltype(&Model::dryFriction)>> : std::true_type {};

/// The generalized force of the friction of all contacts at these shares.
template <class Model, std::size_t n>
std::array<double, n> dryFriction(const Model& model, const DryContacts<n>& contacts,
                                  [[maybe_unused]] const std::array<double, n>& q,
                                  const ContactNumbers& share) {
  if constexpr (HasFrictionOfState<Model>::value) {
    return model.dryFriction(q, share);
  } else {
    std::array<double, n> force{};
    for (std::size_t j = 0; j < contacts.count; ++j) {
      const DryContact<n>& contact = contacts.at[j];
      for (std::size_t i = 0; i < n; ++i) {
        force[i] -= share[j] * contact.level * contact.direction[i];
      }
    }
    return force;
  }
}

/// Which contacts are held, and the shares of all; those of held contacts are found.
template <std::size_t n>
struct DryState {
  std::array<bool, kMaxContacts> held{};
  ContactNumbers share{};

  bool holdsAny() const { return held[0] || held[1]; }
};

/// q'' of mass . q'' = force + friction(share), into state.share the shares at which the held
/// contacts stay without sliding. `force` is without dry friction. A contact that nothing could
/// hold gets a share beyond 1. Real-time safe.
template <std::size_t n, class Friction>
std::array<double, n> accelerationWithFriction(const std::array<double, n*(n + 1) / 2>& mass,
                                               const std::array<double, n>& force,
                                               const DryContacts<n>& contacts,
                                               const Friction& friction, DryState<n>& state) {
  const auto solve = [&](const ContactNumbers& share) {
    std::array<double, n> all = friction(share);
    for (std::size_t i = 0; i < n; ++i) {
      all[i] += force[i];
    }
    return solveMass<double, n>(mass, all);
  };
  const auto along = [&](std::size_t j, const std::array<double, n>& a) {
    double sum = 0.0;
    for (std::size_t i = 0; i < n; ++i) {
      sum += contacts.at[j].direction[i] * a[i];
    }
    return sum;
  };
  std::array<double, n> a = solve(state.share);
  // A level that does not depend on the shares takes one round. Where it does each round takes the
  // error down by about the difference: a share of 1 - 1e-9 for 1 would hold what slides.
  constexpr int kMaxRounds = 6;
  constexpr double kDifference = 1.0e-3;
  for (int round = 0; state.holdsAny() && round < kMaxRounds; ++round) {
    // Newton's method; the slopes are differences.
    ContactNumbers residual{};
    std::array<ContactNumbers, kMaxContacts> slope{};  // [contact][by the share of]
    for (std::size_t k = 0; k < kMaxContacts; ++k) {
      slope[k][k] = 1.0;  // of one that is not held: its share stays
      if (!state.held[k]) {
        continue;
      }
      residual[k] = along(k, a);
      ContactNumbers other = state.share;
      const double step = other[k] > 0.0 ? -kDifference : kDifference;
      other[k] += step;
      const std::array<double, n> changed = solve(other);
      for (std::size_t j = 0; j < kMaxContacts; ++j) {
        if (state.held[j]) {
          slope[j][k] = (along(j, changed) - along(j, a)) / step;
        }
      }
    }
    const double determinant = slope[0][0] * slope[1][1] - slope[0][1] * slope[1][0];
    const bool nothing_holds =  // without any normal force
        std::fabs(determinant) <= 1.0e-12 * std::fabs(slope[0][0] * slope[1][1]);
    ContactNumbers change{(slope[0][1] * residual[1] - slope[1][1] * residual[0]) / determinant,
                          (slope[1][0] * residual[0] - slope[0][0] * residual[1]) / determinant};
    double largest = 0.0;
    for (std::size_t k = 0; k < kMaxContacts; ++k) {
      if (nothing_holds) {
        change[k] = residual[k] > 0.0 ? 2.0 : residual[k] < 0.0 ? -2.0 : 0.0;
      }
      state.share[k] += change[k];
      largest = std::max(largest, std::fabs(change[k]) / (1.0 + std::fabs(state.share[k])));
    }
    a = solve(state.share);
    if (largest < 1.0e-12) {
      break;
    }
  }
  for (std::size_t k = 0; k < kMaxContacts; ++k) {  // the remainder is rounding
    if (state.held[k]) {
      const std::array<double, n>& direction = contacts.at[k].direction;
      double square = 0.0;
      for (const double g : direction) {
        square += g * g;
      }
      const double rest = along(k, a) / square;
      for (std::size_t i = 0; i < n; ++i) {
        a[i] -= rest * direction[i];
      }
    }
  }
  return a;
}

/// The state of each contact. A contact at zero sliding velocity sticks or begins to slide to one
/// side: of all combinations the one is chosen in which sticking contacts need no more friction
/// than is available and contacts that begin to slide move against their friction. Real-time safe.
template <std::size_t n, class Friction>
DryState<n> dryState(const std::array<double, n*(n + 1) / 2>& mass,
                     const std::array<double, n>& force, const DryContacts<n>& contacts,
                     const std::array<double, n>& v, const Friction& friction) {
  const ContactNumbers sliding = contacts.slidingShares(v);
  constexpr ContactNumbers kChoices[] = {{0.0, 0.0},  {0.0, 1.0},  {0.0, -1.0},
                                         {1.0, 0.0},  {-1.0, 0.0}, {1.0, 1.0},
                                         {-1.0, 1.0}, {1.0, -1.0}, {-1.0, -1.0}};
  constexpr double kRounding = 1.0e-12;
  DryState<n> best;
  double least = std::numeric_limits<double>::max();
  for (const ContactNumbers& choice : kChoices) {
    DryState<n> state;
    bool possible = true;
    for (std::size_t j = 0; j < kMaxContacts; ++j) {
      const bool free = j < contacts.count && sliding[j] == 0.0;
      possible = possible && (free || choice[j] == 0.0);
      state.share[j] = free ? choice[j] : sliding[j];
      state.held[j] = free && choice[j] == 0.0;
    }
    if (!possible) {
      continue;
    }
    const std::array<double, n> a =
        accelerationWithFriction(mass, force, contacts, friction, state);
    double wrong = 0.0;
    for (std::size_t j = 0; j < contacts.count; ++j) {
      if (state.held[j]) {
        wrong = std::max(wrong, std::fabs(state.share[j]) - 1.0);
      } else if (sliding[j] == 0.0) {
        double along = 0.0;
        double size = std::numeric_limits<double>::min();
        for (std::size_t i = 0; i < n; ++i) {
          along += contacts.at[j].direction[i] * a[i];
          size += std::fabs(contacts.at[j].direction[i] * a[i]);
        }
        wrong = std::max(wrong, -state.share[j] * along / size - kRounding);
      }
    }
    if (wrong < least) {
      least = wrong;
      best = state;
    }
    if (wrong <= 0.0) {
      break;
    }
  }
  return best;
}

}  // namespace whirl_twin
