#include <pluginlib/class_list_macros.hpp>

#include "models/model_entry.h"
#include "models/model_plugin.h"
#include "saddle_trap.h"

namespace saddle_trap {

class SaddleTrapPlugin : public ModelPlugin {
 public:
  ModelInfo info() const override { return modelInfo<SaddleTrap>(); }
};

}  // namespace saddle_trap

PLUGINLIB_EXPORT_CLASS(saddle_trap::SaddleTrapPlugin, whirl_twin::ModelPlugin)
