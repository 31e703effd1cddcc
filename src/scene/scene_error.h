// The exception for an invalid scene.
#pragma once

#include <string>
#include <vector>

#include "messages/input_error.h"

namespace whirl_twin {

/// All errors of one scene, each "source: key: what was expected with its unit, what was found".
class SceneError : public InputError {
 public:
  explicit SceneError(std::vector<std::string> errors);
  const std::vector<std::string>& errors() const { return errors_; }

 private:
  std::vector<std::string> errors_;
};

}  // namespace whirl_twin
