#include "mechanics/pendulums/elastic_pendulum.h"

#include "models/model_entry.h"
#include "models/models.h"

namespace whirl_twin {

ModelInfo elasticPendulumInfo() {
  return modelInfo<ElasticPendulum>();
}

}  // namespace whirl_twin
