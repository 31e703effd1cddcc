// Models of other packages, by pluginlib: any package that depends on whirl_twin and exports a
// class description to it (docs/own_systems.md).
#pragma once

namespace whirl_twin {

/// Makes scenes find the models of plugins beside the built-in ones. Nothing is searched or loaded
/// before a scene names a model that is not built in, or all models are listed. What cannot be
/// loaded costs one line on standard error; the rest is there.
void usePluginModels();

}  // namespace whirl_twin
