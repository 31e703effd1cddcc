#!/usr/bin/python3
"""usage: run_trials.py NAME...

Runs trials one after the other in one process, on the master there is: NAME is a file here without its ending, a class
in it or a test of that, as Python's unittest names them: clock_test.ClockOfTheTwin.test_states_that_leave_together."""
import sys
import unittest

import rospy
import rostest


def trials():
    return unittest.defaultTestLoader.loadTestsFromNames(
        [name for name in rospy.myargv(sys.argv)[1:] if not name.startswith('--')])


if __name__ == '__main__':
    rospy.init_node('trials')
    rostest.rosrun('whirl_twin', 'trials', '__main__.trials', sys.argv)
