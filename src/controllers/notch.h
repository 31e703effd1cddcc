// A synchronous notch in front of a controller: it subtracts the synchronous (1X) component from
// the measurement, so that the controller does not respond to unbalance (R. Herzog, P. Buehler, C.
// Gaehler, R. Larsonneur, IEEE Trans. Control Systems Technology 4 (1996) 580). At the shaft's
// angle theta
//
//   shown = y - c e^(j theta),   c' = rate e^(j phase) e^(-j theta) shown,
//
// y = y1 + j y2 of two probes, the second a quarter turn on in the sense of rotation. Of a probe by
// itself shown = y - 2 Re(c e^(j theta)). A slow notch is stable at a speed Omega if its phase is
// within a quarter turn of -arg S(j Omega), S the sensitivity of the loop without it: the pole it
// adds is near j Omega - rate e^(j phase) S(j Omega). Without a phase that fails below a rotor's
// rigid modes; with -arg S it is as stable as can be.
#pragma once

#include "controllers/controller_info.h"

namespace whirl_twin {

/// The controller with a notch in front of it, with the parameters notch_rate (0: none),
/// notch_phase and notch_hold and the settings notch_phases and notch_axes.
ControllerInfo withNotch(ControllerInfo info);

}  // namespace whirl_twin
