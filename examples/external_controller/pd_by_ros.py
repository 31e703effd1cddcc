#!/usr/bin/python3
"""A PD law in a process of its own, by ROS: u = -(kp y + kd y'), the derivative a backward difference.

usage: pd_by_ros.py CONTROLLER RATE KP KD

CONTROLLER: its name in the scene, whose rate is RATE [Hz]. The law is that of the built-in pid, in the same order of
operations.
"""
import sys

import rospy
from whirl_twin.msg import ControllerCommand, ControllerMeasurement


class Pd:
    def __init__(self, name, rate, kp, kd):
        self.slope_gain = 1.0 / (1.0 / rate)
        self.kp, self.kd = kp, kd
        self.run = self.last = None
        topic = '/twin/controllers/' + name
        self.command = rospy.Publisher(topic + '/command', ControllerCommand, queue_size=100, tcp_nodelay=True)
        rospy.Subscriber(topic + '/measurement', ControllerMeasurement, self.take, queue_size=1000, tcp_nodelay=True)

    def take(self, measurement):
        y = measurement.values
        if measurement.run != self.run:  # the first, or the first after a reset: there is none before it
            self.run, self.last = measurement.run, y
        values = [self.kp * (0.0 - now) - self.kd * (self.slope_gain * (now - last)) for now, last in zip(y, self.last)]
        self.last = y
        self.command.publish(ControllerCommand(sample=measurement.sample, time=measurement.time, values=values,
                                               run=measurement.run))


if __name__ == '__main__':
    arguments = rospy.myargv(sys.argv)
    if len(arguments) != 5:
        sys.exit(__doc__)
    rospy.init_node('pd_by_ros', anonymous=True)
    Pd(arguments[1], *map(float, arguments[2:]))
    rospy.spin()
