// Ctrl-C, for commands that go on until they are told to end.
#pragma once

namespace whirl_twin {

/// From now on SIGINT and SIGTERM only ask for the end.
void catchInterrupts();

/// Whether they have.
bool interrupted();

}  // namespace whirl_twin
