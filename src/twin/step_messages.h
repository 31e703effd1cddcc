// The messages of a step, common to all publishers, writers and discovery: for each system its
// whirl or coordinates, for each drive its motion and that of its motor, parameters, statistics of
// ensembles.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "messages/message.h"
#include "scene/signal_names.h"
#include "twin/observer.h"
#include "twin/order_observer.h"

namespace whirl_twin {

class StepMessages {
 public:
  /// Of these systems of a scene and their drives, or of all systems and drives.
  explicit StepMessages(const BuiltScene& scene);
  StepMessages(const BuiltScene& scene, std::vector<std::size_t> systems);

  /// announce(KindOf<State>, subject) for all messages to be published.
  template <class Announce>
  void announce(Announce&& announce) const {
    eachState([&](const std::string& subject, std::size_t, auto state) {
      announce(KindOf<decltype(state(std::declval<const Observer&>()))>{}, subject);
    });
    for (const std::size_t system : systems_) {
      if (built_[system]->dynamics->isRotor()) {
        for (const std::string& station :
             publishedStations(nameOf(system), *built_[system]->dynamics)) {
          announce(KindOf<state::OrderState>{}, station);
        }
      }
      announce(KindOf<state::ParameterChange>{}, nameOf(system));
      if (built_[system]->spec.ensemble.count > 0) {
        announce(KindOf<state::EnsembleState>{}, nameOf(system));
      }
    }
    for (const std::size_t controller : tunable_) {
      announce(KindOf<state::ParameterChange>{}, controller_names_[controller]);
    }
  }

  /// Passes the messages of the observer's step to `sink`; none for a system that has stopped.
  ///   sink(subject, make)   make() returns the message; may be omitted without a receiver
  ///   sink.change(change)   parameters, at the start and after a change
  ///   sink.again(change)    the same every 10 s of simulated time, for late subscribers
  /// all: false omits all but the parameters.
  template <class Sink>
  void tell(const Observer& observer, bool all, Sink&& sink) {
    for (std::size_t i = 0; i < systems_.size(); ++i) {
      tellParameters(observer.instant(), observer.generation(systems_[i]),
                     observer.parameters(systems_[i]), published_[i], sink);
    }
    for (std::size_t i = 0; i < tunable_.size(); ++i) {
      tellParameters(observer.instant(), observer.controllerGeneration(tunable_[i]),
                     observer.controllerParameters(tunable_[i]), published_[systems_.size() + i],
                     sink);
    }
    if (!all) {
      return;
    }
    eachState([&](const std::string& subject, std::size_t runs, auto state) {
      if (runs == Twin::kNoSystem || observer.status(runs) == StepStatus::kOk) {
        sink(subject, [&observer, state] { return state(observer); });
      }
    });
  }

  /// Calls sink(subject, make) for the orders that are due at the observer's step.
  template <class Sink>
  void tellOrders(const Observer& observer, const OrderObserver& orders, Sink&& sink) const {
    orders.tell(observer, systems_, sink);
  }

  /// The last published parameters as sink.again(change), for late subscribers.
  template <class Sink>
  void tellAgain(Sink&& sink) const {
    for (const Published& published : published_) {
      if (!published.parameters.system.empty()) {
        sink.again(published.parameters);
      }
    }
  }

  /// Calls sink(subject, make) for the statistics of the ensembles for which take(system, now, out)
  /// has new ones.
  template <class Take, class Sink>
  void tellEnsembles(const Observer& observer, Take&& take, Sink&& sink) const {
    state::EnsembleState ensemble;
    for (const std::size_t system : systems_) {
      if (built_[system]->spec.ensemble.count > 0 && take(system, observer.instant(), ensemble)) {
        sink(nameOf(system), [&ensemble] { return ensemble; });
      }
    }
  }

 private:
  struct Published {
    std::int64_t generation = -1;
    state::ParameterChange parameters;
    double time = 0.0;  // [s], simulated, of the last publication
  };
  static constexpr double kAgain = 10.0;  // s, simulated

  const std::string& nameOf(std::size_t system) const { return built_[system]->spec.name; }

  /// visit(subject, system that must be running, state(observer)): every state.
  template <class Visit>
  void eachState(Visit&& visit) const {
    for (const std::size_t i : systems_) {
      if (built_[i]->dynamics->isRotor()) {
        const std::vector<std::string> stations =
            publishedStations(nameOf(i), *built_[i]->dynamics);
        for (std::size_t k = 0; k < stations.size(); ++k) {
          visit(stations[k], i, [i, k](const Observer& observer) { return observer.whirl(i, k); });
        }
      } else {
        visit(nameOf(i), i, [i](const Observer& observer) { return observer.pendulum(i); });
      }
    }
    for (const std::size_t i : drives_) {
      visit(scene_drives_[i].name, Twin::kNoSystem,
            [i](const Observer& observer) { return observer.drive(i); });
      if (scene_drives_[i].motor) {
        visit(scene_drives_[i].name, turned_by_[i],
              [i](const Observer& observer) { return observer.motor(i); });
      }
    }
    for (const std::size_t i : controllers_) {
      visit(controller_names_[i], Twin::kNoSystem,
            [i](const Observer& observer) { return observer.controller(i); });
    }
  }

  template <class Sink>
  static void tellParameters(const state::Instant& at, std::int64_t generation,
                             const state::ParameterChange& now, Published& published, Sink& sink) {
    if (generation != published.generation) {
      published.generation = generation;
      // A system prepared for other speeds is a new generation with the same parameters.
      if (published.parameters.system.empty() || now.values != published.parameters.values) {
        published.parameters = now;
        published.parameters.at = at;
        published.time = at.time;
        sink.change(published.parameters);
      }
    }
    if (std::fabs(at.time - published.time) >= kAgain) {
      published.time = at.time;
      sink.again(published.parameters);
    }
  }

  std::vector<SharedSystem> built_;      // all of the scene
  std::vector<DriveSpec> scene_drives_;  // likewise
  std::vector<std::size_t> turned_by_;   // for each of them, the last of its systems
  std::vector<std::size_t> systems_;
  std::set<std::size_t> drives_;
  std::vector<std::string> controller_names_;  // of all of the scene
  std::vector<std::size_t> controllers_;       // those that measure or act on systems_
  std::vector<std::size_t> tunable_;           // of these, those with parameters
  std::vector<Published> published_;           // of systems_, then of tunable_
};

}  // namespace whirl_twin
