// All general solvers available at build time.
#pragma once

#include <string>
#include <vector>

#include "odeint_peers.h"
#include "scene.h"
#ifdef WHIRL_TWIN_PEER_GSL
#include "gsl_peers.h"
#endif
#ifdef WHIRL_TWIN_PEER_CVODE
#include "cvode_peers.h"
#endif

namespace whirl_twin::comparison {

template <class Equations>
void addPeers(const Problem<Equations>& problem, std::vector<Contender>& contenders) {
  addOdeint(problem, contenders);
#ifdef WHIRL_TWIN_PEER_GSL
  addGsl(problem, contenders);
#endif
#ifdef WHIRL_TWIN_PEER_CVODE
  addCvode(problem, contenders);
#endif
}

/// Libraries that take part, with their versions, and those that were not found.
struct Peers {
  std::vector<std::string> present, missing;
};
Peers peers();

}  // namespace whirl_twin::comparison
