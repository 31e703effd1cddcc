// Plugin interface for a controller of another package, which scenes then name like a built-in
// one.
//
//   class PositionFeedbackPlugin : public whirl_twin::ControllerPlugin {
//    public:
//     whirl_twin::ControllerInfo info() const override {
//       return whirl_twin::controllerInfo<PositionFeedback>();
//     }
//   };
//
// controllerInfo() is of controllers/controller_entry.h.
#pragma once

#include "controllers/controller_info.h"

namespace whirl_twin {

class ControllerPlugin {
 public:
  virtual ~ControllerPlugin() = default;
  virtual ControllerInfo info() const = 0;
};

}  // namespace whirl_twin
