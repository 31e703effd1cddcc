"""What rviz is given: instruments with a live verdict, limits, the loop's health, a frame for the camera; and where the
monitor has died no margin that looks live."""
import os

import rospy
from tf2_msgs.msg import TFMessage
from visualization_msgs.msg import Marker, MarkerArray

from node_trial import PACKAGE, SCENES, NodeTrial, load_parameters, load_scene, wait_until


class Visualization(NodeTrial):
    def setUp(self):
        super().setUp()
        self.markers = {}
        self.frames = set()
        self.listen('/twin/markers', MarkerArray, self.take)
        self.listen('/tf', TFMessage, lambda m: self.frames.update(t.child_frame_id for t in m.transforms))
        load_scene(os.path.join(SCENES, 'demo.yaml'))
        load_parameters(os.path.join(PACKAGE, 'config', 'monitor.yaml'), '/monitor_node')
        rospy.set_param('/monitor_node/zones', {'rotor': {'a': 80.0e-6, 'b': 150.0e-6, 'c': 220.0e-6}})
        self.start('simulation_node', '_realtime:=ignore')
        self.monitor = self.start('monitor_node')
        self.start('visualization_node')

    def take(self, array):
        self.markers = {(m.ns, m.id): m for m in array.markers}

    def shown(self, part, number=0):
        marker = self.markers.get((part, number))
        return marker is not None and marker.action == Marker.ADD

    def text(self, part):
        marker = self.markers.get((part, 0))
        return marker.text if marker else ''

    def test_a_margin_is_shown_while_it_is_live(self):
        self.assertTrue(wait_until(lambda: self.shown('rotor/margin_pointer')))
        self.assertTrue(wait_until(lambda: 'decay rate' in self.text('pendulum/text')), self.text('pendulum/text'))
        self.assertFalse(self.shown('pendulum/margin_pointer'))  # no damping is required of one
        self.assertTrue(self.shown('rotor/speed_avoid'))
        self.assertFalse(self.shown('pendulum/speed_avoid'))
        self.assertIn('avoid 48.1 to 70.7', self.text('rotor/speed_caption'))
        self.assertIn('log decrement 0.315 (0.1 required)', self.text('rotor/margin_caption'))
        self.assertTrue(wait_until(lambda: 'zone C 110 um' in self.text('rotor/text')), self.text('rotor/text'))
        self.assertTrue(wait_until(lambda: self.text('(twin)/loop').startswith('loop: 1000 steps/s')))
        self.assertTrue(wait_until(lambda: 'oldest verdict' in self.text('(twin)/monitor')), self.text('(twin)/monitor'))
        self.assertTrue(wait_until(lambda: 'twin_view' in self.frames))

        self.end(self.monitor)
        self.assertTrue(wait_until(lambda: not self.shown('rotor/margin_pointer')))
        self.assertFalse(self.shown('rotor/speed_avoid'))
        self.assertTrue(self.shown('rotor/speed_pointer'))  # the states go on
        # The verdict is too old first, then its monitor is missed.
        self.assertTrue(wait_until(lambda: self.text('rotor/margin_caption') == 'margin: no message from the monitor'),
                        self.text('rotor/margin_caption'))
        self.assertTrue(self.text('(twin)/title').startswith('alarms unknown'))
