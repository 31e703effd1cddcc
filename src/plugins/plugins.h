// Models and controllers of other packages, by pluginlib: any package that depends on whirl_twin
// and exports a class description to it (docs/own_systems.md, docs/own_controllers.md).
#pragma once

namespace whirl_twin {

/// Registers the models and controllers of plugins in addition to the built-in ones. Nothing is
/// searched or loaded before a scene names one that is not built in, or all are listed. A plugin
/// that cannot be loaded causes one line on standard error; the others are available.
void usePlugins();

}  // namespace whirl_twin
