#include "mechanics/pendulums/elastic_pendulum.h"

#include "models/model_entry.h"
#include "models/small_systems.h"

namespace whirl_twin {

ModelInfo elasticPendulumInfo() {
  return modelInfo<ElasticPendulum>();
}

}  // namespace whirl_twin
