// Long work called from Python: it runs on a second thread, which never touches Python, while
// the calling thread, without the interpreter's lock, waits for it, looks for Ctrl-C, calls the
// progress callback, and hands on what a command would print on standard error.
#pragma once

#include <pybind11/pybind11.h>

#include <functional>

#include "requests/work_progress.h"

namespace whirl_twin {

/// `progress`: None, or called with the part of the work that is done, 0 to 1. Throws what the work
/// throws; KeyboardInterrupt, or the exception of the callback, after the work has ended: at the
/// next step, or, where work cannot be divided, when it is done.
void runListening(const pybind11::object& progress, const std::function<void(WorkProgress&)>& work);

/// Looks for Ctrl-C, called without the interpreter's lock. Throws error_already_set.
void requireNoSignal();

/// Messages that a command prints on standard error go to the logger whirl_twin from now on.
void takeMessages();
/// Hands on those that have arrived since. With the interpreter's lock.
void handOnMessages();

}  // namespace whirl_twin
