#include "twin/ensemble_observer.h"

#include <algorithm>

#include "twin/ensemble_statistics.h"
#include "twin/record.h"

namespace whirl_twin {

EnsembleObserver::EnsembleObserver(Twin& twin) : twin_(twin), last_steps_(twin.systems().size()) {
  for (std::size_t i = 0; i < twin.systems().size(); ++i) {
    if (twin.ensemble(i) != nullptr) {
      systems_.push_back(i);
      record_.resize(std::max(record_.size(), twin.ensemble(i)->recordSize()));
    }
  }
}

bool EnsembleObserver::take(std::size_t system, const state::Instant& now,
                            state::EnsembleState& out) {
  Ensemble& ensemble = *twin_.ensemble(system);
  if (!ensemble.take(record_.data())) {
    return false;
  }
  out = ensembleStatistics(ensemble, record_.data());
  out.system = twin_.systems()[system]->spec.name;
  out.at.time = twin_.seconds(out.at.step);
  // A reset that `now` is still before: its step tells nothing of the stamp.
  const bool went_back = out.at.step < last_steps_[system];
  last_steps_[system] = out.at.step;
  out.at.stamp = went_back ? now.stamp : now.stamp + (out.at.step - now.step) * twin_.scene().step;
  return true;
}

}  // namespace whirl_twin
