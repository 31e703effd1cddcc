"""What comes from outside ends no node, takes no memory, and comes from this machine only while ROS is on the loopback
address; the history of the alarms survives a disk that is full."""
import os
import re
import signal
import socket
import struct

import roslib.packages
from whirl_twin.msg import AlertArray, LoopStatistics, ParameterChange

from node_trial import NodeTrial, load_scene, wait_until

DANGER = """
name: danger
step: 0.001
drives: {shaft: {speed: 58.0}}
systems:
  rotor:
    model: jeffcott_rotor
    drive: shaft
    parameters: {mass: 2.0, stiffness: 7200.0, damping: 12.0, eccentricity: 1.0e-4}
  unstable:
    model: jeffcott_rotor
    drive: shaft
    parameters: {mass: 2.0, stiffness: 800.0, damping: 8.0, eccentricity: 1.0e-6, internal_damping: 8.0}
"""
MONITOR = 'monitor_node: monitor'


def listening(process):
    """(address, port) of its sockets that wait for connections, as the kernel has them."""
    files = '/proc/%d/fd/' % process.pid
    inodes = {re.sub(r'\D', '', link) for link in map(os.readlink, (files + name for name in os.listdir(files)))
              if link.startswith('socket:')}
    with open('/proc/%d/net/tcp' % process.pid) as table:
        rows = [row.split() for row in table][1:]
    places = [row[1].split(':') for row in rows if row[3] == '0A' and row[9] in inodes]
    return [(socket.inet_ntoa(struct.pack('<I', int(address, 16))), int(port, 16)) for address, port in places]


def anonymous(process):
    """MB of memory of its own."""
    with open('/proc/%d/smaps_rollup' % process.pid) as rows:
        return int(next(row for row in rows if row.startswith('Anonymous')).split()[1]) / 1e3


class Outside(NodeTrial):
    def setUp(self):
        super().setUp()
        with open(self.path('danger.yaml'), 'w') as file:
            file.write(DANGER)
        load_scene(self.path('danger.yaml'))
        self.loops, self.alerts = [], {}
        self.listen('/twin/loop', LoopStatistics, self.loops.append)
        self.listen('/twin/alerts', AlertArray, self.take_alerts)

    def take_alerts(self, message):
        self.alerts = {(a.type, a.system): a for a in message.alerts}

    def in_danger(self):
        return all(key in self.alerts for key in (('IN_CRITICAL_BAND', 'rotor'), ('UNSTABLE', 'unstable')))

    def test_nodes_listen_on_loopback_and_an_announced_length_takes_no_memory(self):
        simulation, _ = self.start('simulation_node', '_realtime:=warn')
        monitor, _ = self.start('monitor_node')
        self.assertTrue(wait_until(lambda: self.loops and self.in_danger()))
        for process in (simulation, monitor):
            places = listening(process)
            self.assertGreaterEqual(len(places), 2)  # XML-RPC and TCPROS
            self.assertEqual({address for address, _ in places}, {'127.0.0.1'})
        before, kept, steps = anonymous(simulation), [], self.loops[-1].step
        for place in listening(simulation):
            kept.append(socket.create_connection(place, 2))
            kept[-1].send(struct.pack('<I', 900_000_000))
        self.assertTrue(wait_until(lambda: self.loops[-1].step > steps + 2000))
        self.assertLess(anonymous(simulation) - before, 50.0)
        for connection in kept:
            connection.close()

    def test_parameters_that_overflow_leave_the_dangers(self):
        last = []
        self.listen('/twin/rotor/parameters', ParameterChange, last.append)
        self.start('simulation_node', '_realtime:=ignore')
        monitor, _ = self.start('monitor_node')
        self.assertTrue(wait_until(lambda: self.in_danger() and last))
        message = last[-1]
        values = list(message.values)
        values[message.names.index('internal_damping')] = 1e308
        message.values = values
        publisher = self.publisher('/twin/rotor/parameters', ParameterChange)

        def reported():
            publisher.publish(message)  # the monitor may have yet to connect
            return 'rotor: cannot be evaluated' in self.problems()
        self.assertTrue(wait_until(reported))
        self.assertIsNone(monitor.poll())
        self.assertTrue(self.in_danger())

    def test_the_history_goes_on_when_it_can_be_written(self):
        history = self.path('alarms.jsonl')
        os.mkdir(history)  # no file can be opened there
        self.start('simulation_node', '_realtime:=ignore')
        monitor, _ = self.start('monitor_node', '_latch:=all', '_history:=' + history)
        self.assertTrue(wait_until(self.in_danger))
        self.assertTrue(wait_until(lambda: 'the alarm history is not saved' in self.problems()))
        os.rmdir(history)
        self.assertTrue(wait_until(lambda: os.path.exists(history) and 'UNSTABLE' in open(history).read()))
        monitor.send_signal(signal.SIGKILL)
        monitor.wait()
        self.alerts = {}
        self.start('monitor_node', '_latch:=all', '_history:=' + history)
        self.assertTrue(wait_until(self.in_danger))

    def problems(self):
        return self.status[MONITOR].message if MONITOR in self.status else ''
