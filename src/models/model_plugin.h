// Plugin interface for a model of a different package, which scenes can name like a built-in one.
//
//   class SaddleTrapPlugin : public whirl_twin::ModelPlugin {
//    public:
//     whirl_twin::ModelInfo info() const override { return whirl_twin::modelInfo<SaddleTrap>(); }
//   };
//
// modelInfo() is of scene/model_entry.h: the model's steps are compiled where it is called.
#pragma once

#include "models/model_info.h"

namespace whirl_twin {

class ModelPlugin {
 public:
  virtual ~ModelPlugin() = default;
  virtual ModelInfo info() const = 0;
};

}  // namespace whirl_twin
