"""What breaks around the loop (the route of LCM, a subscriber that stalls, too much to send, the wall clock) is counted
and said, and over when it is over."""
import os
import socket
import subprocess
import time
import xmlrpc.client

import roslib.packages
import rosgraph
from rosgraph.network import write_ros_handshake_header
from std_srvs.srv import Trigger
from whirl_twin.msg import AlertArray, LoopStatistics, WhirlState
from whirl_twin.srv import StepN

from node_trial import SCENES, NodeTrial, call, load_scene, wait_until

LOOP = 'simulation_node: real-time loop'
TOPIC = '/twin/rotor/whirl'


class SlowSubscriber:
    """Takes a topic by hand, so that it can stop reading without anything else that notices."""

    def __init__(self, topic):
        node = rosgraph.Master('/slow').lookupNode('/simulation_node')
        _, _, (_, host, port) = xmlrpc.client.ServerProxy(node).requestTopic('/slow', topic, [['TCPROS']])
        self.socket = socket.socket()
        self.socket.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 4096)
        self.socket.settimeout(10.0)
        self.socket.connect((host, port))
        write_ros_handshake_header(self.socket, {'callerid': '/slow', 'topic': topic, 'md5sum': WhirlState._md5sum,
                                                 'type': WhirlState._type, 'tcp_nodelay': '1'})
        self.next()  # its header

    def read(self, size):
        data = b''
        while len(data) < size:
            part = self.socket.recv(size - len(data))
            if not part:
                raise EOFError('the publisher has closed')
            data += part
        return data

    def next(self):
        return self.read(int.from_bytes(self.read(4), 'little'))

    def step(self):
        """The step of the next message."""
        return WhirlState().deserialize(self.next()).step


class Survival(NodeTrial):
    def setUp(self):
        super().setUp()
        self.loops = []
        self.whirls = []
        self.alerts = []
        load_scene(os.path.join(SCENES, 'demo.yaml'))
        self.listen('/twin/loop', LoopStatistics, self.loops.append)

    def diagnosis(self):
        return self.status[LOOP].message if LOOP in self.status else ''

    def expect_diagnosed(self, text):
        self.assertTrue(wait_until(lambda: text in self.diagnosis()), (text, self.diagnosis()))

    def expect_over(self, text):
        """It is not said any more; a machine that has other work may have other troubles."""
        self.assertTrue(wait_until(lambda: self.diagnosis() and text not in self.diagnosis()), self.diagnosis())

    def test_lcm_without_its_route(self):
        self.listen('/twin/alerts', AlertArray, lambda m: setattr(self, 'alerts', [a.type for a in m.alerts]))
        # With ttl=0, the default, it is sent by the loopback interface and needs no route.
        network = '_lcm_url:=udpm://239.255.76.67:7667?ttl=1'
        twin = self.start('simulation_node', '_realtime:=ignore', network)
        self.start('monitor_node', network)
        self.assertTrue(wait_until(lambda: self.loops))
        self.assertEqual(self.loops[-1].lcm_failed, 0)
        route = ['224.0.0.0/4', 'dev', 'lo']
        subprocess.check_call(['ip', 'route', 'del'] + route)
        try:
            self.assertTrue(wait_until(lambda: self.loops[-1].lcm_failed > 1000), self.log(twin))
            self.assertTrue(wait_until(lambda: 'LCM_LOST' in self.alerts))
            self.expect_diagnosed('could not be sent on LCM')
            self.assertTrue(self.says(twin, 'could not be sent on LCM'))
        finally:
            subprocess.check_call(['ip', 'route', 'add'] + route)
        self.assertTrue(wait_until(lambda: 'LCM_LOST' not in self.alerts))
        self.expect_over('could not be sent on LCM')
        self.assertGreater(self.loops[-1].lcm_failed, 1000)
        self.assertTrue(call('/simulation_node/reset_statistics', Trigger).success)
        self.assertTrue(wait_until(lambda: self.loops[-1].lcm_failed == 0))

    def test_a_subscriber_that_stalls(self):
        twin = self.start('simulation_node', '_realtime:=ignore', '_lcm_url:=', '_real_time_factor:=5')
        self.assertTrue(wait_until(lambda: self.loops))
        slow = SlowSubscriber(TOPIC)
        first = slow.step()
        self.assertTrue(wait_until(lambda: self.loops[-1].ros_lost > 2000), self.loops[-1].ros_lost)
        self.expect_diagnosed('a subscriber is too slow')
        self.assertTrue(wait_until(lambda: self.says(twin, 'a subscriber of %s is too slow: .*/slow' % TOPIC)))
        # It reads on: what it misses is what was counted.
        call('/simulation_node/pause', Trigger)
        last = call('/simulation_node/step', StepN, 1).step
        missed, step = 0, first
        while step < last:
            next_step = slow.step()
            missed += next_step - step - 1
            step = next_step
        heard = len(self.loops)
        self.assertTrue(wait_until(lambda: len(self.loops) > heard + 1))
        loop = self.loops[-1]
        self.assertGreaterEqual(missed, loop.ros_lost - 2)
        self.assertLessEqual(missed, loop.ros_lost + loop.dropped_snapshots + 2)
        slow.socket.close()
        self.assertTrue(call('/simulation_node/resume', Trigger).success)
        self.expect_over('a subscriber is too slow')

    def test_more_than_can_be_sent(self):
        self.listen(TOPIC, WhirlState, self.whirls.append)
        self.start('simulation_node', '_realtime:=ignore', '_real_time_factor:=200')
        self.assertTrue(wait_until(lambda: self.loops and self.loops[-1].publish_every > 1))
        heard = len(self.loops)
        self.assertTrue(wait_until(lambda: len(self.loops) > heard + 5), 'the statistics go on')
        self.expect_diagnosed('publisher too slow')
        self.assertGreater(self.loops[-1].dropped_snapshots, 0)
        # What is left out is left out evenly: one of so many, a power of two.
        every = min(loop.publish_every for loop in self.loops[-5:])
        self.assertEqual(every & (every - 1), 0)
        self.assertTrue(all(whirl.step % every == 0 for whirl in self.whirls[-50:]), every)

    def test_the_wall_clock_is_set(self):
        offset = os.path.join(self.folder.name, 'offset')
        with open(offset, 'wb') as file:
            file.write(bytes(8))
        self.listen(TOPIC, WhirlState, self.whirls.append)
        twin = self.start('simulation_node', '_realtime:=ignore', '_lcm_url:=', WALL_CLOCK_OFFSET=offset,
                          LD_PRELOAD=os.path.join(os.path.dirname(roslib.packages.find_node(
                              'whirl_twin', 'simulation_node')[0]), '..', 'libstepped_clock.so'))
        self.assertTrue(wait_until(lambda: len(self.whirls) > 1000))
        self.assertLess(abs(self.whirls[-1].header.stamp.to_sec() - time.time()), 60.0)
        for hours in (1, -1):
            with open(offset, 'r+b') as file:
                file.write((hours * 3600 * 10**9).to_bytes(8, 'little', signed=True))
            self.assertTrue(wait_until(
                lambda: abs(self.whirls[-1].header.stamp.to_sec() - time.time() - hours * 3600) < 60.0))
            self.assertTrue(wait_until(
                lambda: abs(self.loops[-1].header.stamp.to_sec() - time.time() - hours * 3600) < 60.0))
        self.assertTrue(self.says(twin, r'the wall clock was set by \+36\d\d\.\d+ s'))
        steps = [whirl.step for whirl in self.whirls]
        self.assertEqual(steps, sorted(steps))
