#!/usr/bin/python3
"""Where a rotor whirls, ten times a second, from LCM: its speed, its radius, its lag behind the phase mark of the shaft.

usage: whirl_by_lcm.py CHANNEL [URL]     CHANNEL: TWIN_ROTOR_WHIRL say

The types are those that the build of whirl_twin generates: source its setup.bash, or in a project of one's own
lcm-gen --python --package-prefix whirl_twin_lcm msg/*.lcm. (A package `whirl_twin` would hide that of the ROS messages.)
"""
import math
import sys

from lcm_receiver import LcmReceiver
from whirl_twin_lcm.whirl_twin import whirl_state_t

EVERY = 100  # steps


def show(state):
    if state.step % EVERY == 0:
        lag = '%.2f' % math.degrees(state.phase) if state.phase_valid else '-'
        print('%.3f s  %.3f rad/s  %.5f mm  %s deg' % (state.time, state.speed, 1e3 * state.radius, lag), flush=True)


if __name__ == '__main__':
    if not 2 <= len(sys.argv) <= 3:
        sys.exit(__doc__)
    for channel, data in LcmReceiver(*sys.argv[2:]):
        if channel == sys.argv[1]:
            show(whirl_state_t.decode(data))
