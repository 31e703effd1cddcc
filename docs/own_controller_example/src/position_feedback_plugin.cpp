#include <pluginlib/class_list_macros.hpp>

#include "controllers/controller_plugin.h"
#include "position_feedback.h"

namespace position_feedback {

class PositionFeedbackPlugin : public ControllerPlugin {
 public:
  ControllerInfo info() const override { return controllerInfo<PositionFeedback>(); }
};

}  // namespace position_feedback

PLUGINLIB_EXPORT_CLASS(position_feedback::PositionFeedbackPlugin, whirl_twin::ControllerPlugin)
