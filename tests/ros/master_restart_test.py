#!/usr/bin/python3
"""The ROS master is killed under a running twin and started again: the same processes are found as before,
with topics, services, scene and alerts, and LCM has no hole."""
import json
import os
import signal
import subprocess
import sys
import tempfile
import threading
import time
import unittest
import xmlrpc.client
import xmlrpc.server

import roslib.packages
import rosgraph
import rospkg
import rosparam
import rostest

PORT = 11499
PATIENCE = 30.0  # s
SCENE = os.path.join(rospkg.RosPack().get_path('whirl_twin'), 'tests', 'ros', 'scenes', 'threshold.yaml')
TOPICS = ['/twin/rotor/whirl', '/twin/loop', '/twin/alerts', '/twin/rotor/stability', '/diagnostics']
SERVICES = ['/simulation_node/set_speed', '/simulation_node/reset']


def wait_until(condition):
    end = time.monotonic() + PATIENCE
    while not condition() and time.monotonic() < end:
        time.sleep(0.2)
    return condition()


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


class MasterRestart(unittest.TestCase):
    def setUp(self):
        self.environment = dict(os.environ, ROS_MASTER_URI='http://127.0.0.1:%d' % PORT)
        self.master = rosgraph.Master('/test', 'http://127.0.0.1:%d' % PORT)
        self.processes = []
        self.folder = tempfile.TemporaryDirectory()
        self.start_master()
        (scene, _), = rosparam.load_file(SCENE)
        self.master.setParam('/twin/scene', scene)
        self.master.setParam('/twin/scene_file', SCENE)

    def tearDown(self):
        for process in reversed(self.processes):
            if process.poll() is None:
                process.send_signal(signal.SIGINT)
        for process in reversed(self.processes):
            process.wait(20)
        self.folder.cleanup()

    def start(self, command, **options):
        process = subprocess.Popen(command, env=self.environment, **options)
        self.processes.append(process)
        return process

    def start_node(self, node, *arguments):
        program = roslib.packages.find_node('whirl_twin', node)[0]
        log = open(os.path.join(self.folder.name, '%s%d.log' % (node, len(self.processes))), 'w+')
        self.start([program] + list(arguments), stdout=log, stderr=subprocess.STDOUT)
        return log

    def start_master(self):
        # rosmaster alone: roscore would also start rosout, another process to wait for.
        self.core = self.start(['rosmaster', '--core', '-p', str(PORT)], stdout=subprocess.DEVNULL,
                               stderr=subprocess.DEVNULL)
        self.assertTrue(wait_until(self.master.is_online), 'no master')

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
        return subprocess.run(['rostopic', 'echo', '-n1', topic], env=self.environment, timeout=PATIENCE,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, universal_newlines=True)

    def run_to(self, speed):
        answer = subprocess.run(['rosservice', 'call', '/simulation_node/set_speed',
                                 '{drive: shaft, speed: %g, max_acceleration: 200.0, max_jerk: 0.0}' % speed],
                                env=self.environment, timeout=PATIENCE, stdout=subprocess.PIPE,
                                universal_newlines=True)
        self.assertIn('success: True', answer.stdout)

    def test_one_that_dies_while_a_node_subscribes_does_not_keep_the_node(self):
        dying = DyingMaster(self.environment['ROS_MASTER_URI'])
        self.environment['ROS_MASTER_URI'] = 'http://127.0.0.1:%d' % dying.server_address[1]
        self.start_node('monitor_node')
        self.assertTrue(dying.dead.wait(PATIENCE))
        time.sleep(2.0)
        monitor = self.processes[-1]
        self.assertIsNone(monitor.poll())
        monitor.send_signal(signal.SIGINT)
        monitor.wait(20)

    def test_everything_is_back(self):
        log = os.path.join(self.folder.name, 'run.lcmlog')
        said = self.start_node('simulation_node', '_realtime:=ignore')
        self.start_node('monitor_node', '_latch:=danger')
        recorder = self.start([roslib.packages.find_node('whirl_twin', 'lcm_recorder_node')[0], '_log:=' + log],
                              stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
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
        said.seek(0)
        self.assertIn('the ROS master was restarted', said.read())

        recorder.send_signal(signal.SIGINT)
        recorder.wait(20)
        twin = roslib.packages.find_node('whirl_twin', 'simulation_node')[0]
        program = os.path.join(os.path.dirname(twin), '..', '..', '..', 'bin', 'twin')
        summary = json.loads(subprocess.run([program, 'log', log, '--json'], stdout=subprocess.PIPE).stdout)
        # Over an outage of three seconds: a loaded machine may lose a message here and there.
        self.assertLess(summary['channels']['TWIN_ROTOR_WHIRL']['lost'], 300, summary)


if __name__ == '__main__':
    rostest.rosrun('whirl_twin', 'master_restart_test', MasterRestart, sys.argv)
