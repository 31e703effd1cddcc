#!/usr/bin/python3
"""Where a rotor whirls, ten times a second, from ROS: its speed, its radius, its lag behind the phase mark of the shaft.

usage: whirl_by_ros.py SYSTEM            SYSTEM: its name in the scene, rotor say
"""
import math
import sys

import rospy
from whirl_twin.msg import WhirlState

EVERY = 100  # steps


def show(state):
    if state.step % EVERY == 0:
        lag = '%.2f' % math.degrees(state.phase) if state.phase_valid else '-'
        print('%.3f s  %.3f rad/s  %.5f mm  %s deg' % (state.time, state.speed, 1e3 * state.radius, lag), flush=True)


if __name__ == '__main__':
    arguments = rospy.myargv(sys.argv)
    if len(arguments) != 2:
        sys.exit(__doc__)
    rospy.init_node('whirl_by_ros', anonymous=True)
    rospy.Subscriber('/twin/%s/whirl' % arguments[1], WhirlState, show, queue_size=1000, tcp_nodelay=True)
    rospy.spin()
