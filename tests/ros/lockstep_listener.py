#!/usr/bin/python3
"""A node in lockstep with a twin: hears its states, takes its time for each, and acknowledges it. It writes to a file what it
heard and when (CLOCK_MONOTONIC): step, heard at, acknowledged at.

    lockstep_listener.py FILE SECONDS __name:=NAME"""
import sys
import time

import rospy
from std_msgs.msg import Int64
from whirl_twin.msg import WhirlState

_, path, seconds = rospy.myargv(sys.argv)
rospy.init_node('listener')
acknowledged = rospy.Publisher('/twin/lockstep', Int64, queue_size=100, tcp_nodelay=True)
log = open(path, 'a', buffering=1)


def take(whirl):
    heard = time.monotonic()
    time.sleep(float(seconds))
    log.write('%d %.9f %.9f\n' % (whirl.step, heard, time.monotonic()))
    if not rospy.is_shutdown():
        acknowledged.publish(whirl.step)


rospy.Subscriber('/twin/rotor/whirl', WhirlState, take, tcp_nodelay=True)
rospy.spin()
