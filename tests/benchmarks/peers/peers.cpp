#include "peers.h"

#include <boost/version.hpp>
#ifdef WHIRL_TWIN_PEER_GSL
#include <gsl/gsl_version.h>
#endif
#ifdef WHIRL_TWIN_PEER_CVODE
#include <sundials/sundials_config.h>
#endif
#ifdef WHIRL_TWIN_PEER_MUJOCO
#include <mujoco/mujoco.h>
#endif

namespace whirl_twin::comparison {

Peers peers() {
  Peers all;
  all.present.push_back("Boost.odeint " + std::to_string(BOOST_VERSION / 100000) + "." +
                        std::to_string(BOOST_VERSION / 100 % 1000));
#ifdef WHIRL_TWIN_PEER_GSL
  all.present.push_back("GSL " GSL_VERSION);
#else
  all.missing.push_back("GSL");
#endif
#ifdef WHIRL_TWIN_PEER_CVODE
  all.present.push_back("SUNDIALS " SUNDIALS_VERSION);
#else
  all.missing.push_back("SUNDIALS CVODE");
#endif
#ifdef WHIRL_TWIN_PEER_MUJOCO
  all.present.push_back(std::string("MuJoCo ") + mj_versionString());
#else
  all.missing.push_back("MuJoCo");
#endif
  return all;
}

}  // namespace whirl_twin::comparison
