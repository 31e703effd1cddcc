"""The ROS master is killed under a running twin and started again: the same processes are found as before,
with topics, services, scene and alerts, and LCM has no hole."""
import json
import os
import signal
import subprocess
import threading
import time
import xmlrpc.client
import xmlrpc.server

import rosgraph
import rosparam

from node_trial import PATIENCE, TRIAL_SCENES, NodeTrial, wait_until

PORT = 11499
SCENE = os.path.join(TRIAL_SCENES, 'threshold.yaml')
TOPICS = ['/twin/rotor/whirl', '/twin/loop', '/twin/alerts', '/twin/rotor/stability', '/diagnostics']
SERVICES = ['/simulation_node/set_speed', '/simulation_node/reset']


class DyingMaster(xmlrpc.server.SimpleXMLRPCServer):
    """Hands on to the master at `uri` what it is asked, until somebody registers a subscriber: from then on nobody
    hears it."""

    def __init__(self, uri):
        super().__init__(('127.0.0.1', 0), logRequests=False)
        self.uri = uri
        self.dead = threading.Event()
        threading.Thread(target=self.serve_forever, kwargs={'poll_interval': 0.05}, daemon=True).start()

    def _dispatch(self, method, arguments):
        if method == 'registerSubscriber':
            self.dead.set()
            threading.Thread(target=self.die).start()
            time.sleep(1.0)  # the listening socket is closed before the answer
            raise ConnectionError('dead')
        return getattr(xmlrpc.client.ServerProxy(self.uri, allow_none=True), method)(*arguments)

    def die(self):
        self.socket.close()


class MasterRestart(NodeTrial):
    """Beside the master of the other trials, which these nodes do not know."""

    def setUp(self):
        super().setUp()
        self.uri = 'http://127.0.0.1:%d' % PORT
        self.master = rosgraph.Master('/test', self.uri)
        self.start_master()
        (scene, _), = rosparam.load_file(SCENE)
        self.master.setParam('/twin/scene', scene)
        self.master.setParam('/twin/scene_file', SCENE)

    def start_node(self, node, *arguments):
        return self.start(node, *arguments, ROS_MASTER_URI=self.uri)

    def start_master(self):
        # rosmaster alone: roscore would also start rosout, another process to wait for.
        self.core, _ = self.start_program('rosmaster', '--core', '-p', str(PORT))
        self.assertTrue(wait_until(self.master.is_online), 'no master')

    def asked(self, *command):
        """What a command says of that master."""
        return subprocess.run(command, env=dict(os.environ, ROS_MASTER_URI=self.uri), timeout=PATIENCE,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, universal_newlines=True)

    def registered(self):
        try:
            publishers, _, services = self.master.getSystemState()
        except Exception:
            return False
        return (set(TOPICS) <= {topic for topic, _ in publishers} and
                set(SERVICES) <= {service for service, _ in services} and
                self.master.hasParam('/twin/scene'))

    def hears(self, topic):
        """Does somebody new hear the topic, through the master?"""
        return self.asked('rostopic', 'echo', '-n1', topic)

    def run_to(self, speed):
        answer = self.asked('rosservice', 'call', '/simulation_node/set_speed',
                            '{drive: shaft, speed: %g, max_acceleration: 200.0, max_jerk: 0.0}' % speed)
        self.assertIn('success: True', answer.stdout)

    def test_one_that_dies_while_a_node_subscribes_does_not_keep_the_node(self):
        dying = DyingMaster(self.uri)
        self.uri = 'http://127.0.0.1:%d' % dying.server_address[1]
        monitor = self.start_node('monitor_node')
        self.assertTrue(dying.dead.wait(PATIENCE))
        time.sleep(2.0)
        self.assertIsNone(monitor[0].poll())
        self.end(monitor)

    def test_one_that_answers_no_more_does_not_keep_a_node(self):
        nodes = [self.start_node('simulation_node', '_realtime:=ignore'), self.start_node('monitor_node'),
                 self.start_node('lcm_bridge_node', '_lcm_prefix:=OTHER', '__ns:=/other')]
        self.assertTrue(wait_until(self.registered))
        self.core.send_signal(signal.SIGSTOP)  # it accepts calls, and answers none
        try:
            for process, _ in nodes:
                process.send_signal(signal.SIGINT)
            for process, _ in nodes:
                process.wait(PATIENCE)
        finally:
            self.core.send_signal(signal.SIGCONT)

    def test_everything_is_back(self):
        log = self.path('run.lcmlog')
        twin = self.start_node('simulation_node', '_realtime:=ignore')
        self.start_node('monitor_node', '_latch:=danger')
        recorder = self.start_node('lcm_recorder_node', '_log:=' + log)
        self.assertTrue(wait_until(self.registered))
        self.assertTrue(wait_until(lambda: os.path.exists(log)))
        scene = self.master.getParam('/twin/scene')
        self.run_to(250.0)
        self.assertTrue(wait_until(lambda: 'UNSTABLE' in self.hears('/twin/alerts').stdout))
        self.run_to(150.0)
        self.assertTrue(wait_until(lambda: 'latched: True' in self.hears('/twin/alerts').stdout))

        self.core.kill()
        self.core.wait()
        time.sleep(3.0)
        self.start_master()
        self.assertTrue(wait_until(self.registered), self.master.getSystemState())
        self.assertEqual(self.master.getParam('/twin/scene'), scene)
        for topic in TOPICS:
            heard = self.hears(topic)
            self.assertEqual(heard.returncode, 0, heard.stdout)
        self.assertIn('latched: True', self.hears('/twin/alerts').stdout)
        self.run_to(140.0)
        self.assertTrue(self.says(twin, 'the ROS master was restarted'))

        self.end(recorder)
        summary = json.loads(self.asked(os.environ['WHIRL_TWIN_PROGRAM'], 'log', log, '--json').stdout)
        # Over an outage of three seconds: a loaded machine may lose a message here and there.
        self.assertLess(summary['channels']['TWIN_ROTOR_WHIRL']['lost'], 300, summary)
