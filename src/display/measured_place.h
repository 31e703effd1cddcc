// Where sensors show a system to be: the coordinates of the newest sample, of a source of the scene
// that measures each coordinate of the system.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "scene/built_scene.h"
#include "whirl_twin/Measurement.h"

namespace whirl_twin {

class MeasuredPlace {
 public:
  /// Of a system of the scene, by its first source that will do; none: no source measures all of
  /// its coordinates, or it is a rotor, whose whirl is drawn larger than it is.
  static std::optional<MeasuredPlace> of(const BuiltScene& scene, const std::string& system);

  /// The source whose blocks show it.
  const std::string& source() const { return source_; }

  /// Coordinates [m or rad] of the newest sample of a block of which each is valid; empty: there
  /// is none, or the block has not the channels, or in units of another kind.
  std::vector<double> newest(const Measurement& block) const;

 private:
  std::string source_;
  // Of each coordinate:
  std::vector<std::string> channel_;
  std::vector<std::string> unit_;
};

}  // namespace whirl_twin
