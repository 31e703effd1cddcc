"""What anybody may send to a twin and its monitor: no message ends a node, writes to a terminal, silences an alarm unseen or
is taken for the twin's."""
import os
import socket
import struct

import rospy
from std_srvs.srv import Trigger
from whirl_twin.msg import Alert, AlertArray, DriveState, LoopStatistics, MonitorStatus, OrderState
from whirl_twin.srv import Inhibit, SetInput
from whirl_twin_lcm.whirl_twin import alarm_command_t, controller_command_t

from node_trial import ERROR, OK, WARN, NodeTrial, call, load_scene, wait_until

GROUP = ('239.255.76.67', 7667)
SCENE = """
step: 0.001
drives:
  shaft: {speed: %g}
systems:
  rotor:
    model: jeffcott_rotor
    drive: shaft
    parameters: {mass: 2.0, stiffness: 800.0, damping: 8.0, eccentricity: 1.0e-6, internal_damping: 8.0}
    inputs: {force_x: 0.0}
  outside: {model: linear_system, parameters: {names: [x], mass: [[1.0]], stiffness: [[1.0]]}, initial: {x: 1.0e-3}}
controllers:
  pd: {type: external, rate: 50.0, measures: [outside.x], acts_on: [outside.force_x], delay: 0.04, timeout: 0.5}
"""
UNSTABLE, SLOW = 58.0, 8.0  # rad/s


class Hostile(NodeTrial):
    def begin(self, speed):
        self.scene(speed)
        self.alerts, self.steps = {}, 0
        self.listen('/twin/alerts', AlertArray, self.take_alerts)
        self.listen('/twin/loop', LoopStatistics, self.take_loop)
        return self.start('simulation_node', '_realtime:=ignore')

    def scene(self, speed, twin='/twin'):
        scene = self.path('scene%g.yaml' % speed)
        with open(scene, 'w') as file:
            file.write(SCENE % speed)
        load_scene(scene, twin)

    def take_alerts(self, message):
        self.alerts = {(alert.type, alert.system): alert for alert in message.alerts}

    def take_loop(self, loop):
        self.steps = loop.step

    def datagram(self, channel, data):
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as out:
            out.sendto(b'LC02' + struct.pack('>I', 1) + channel.encode() + b'\0' + data, GROUP)

    def expect(self, condition, *process):
        self.assertTrue(wait_until(condition), (self.alerts, self.status, *map(self.log, process)))

    def test_lengths_that_no_controller_means(self):
        simulation = self.begin(SLOW)
        self.expect(lambda: self.steps > 0, simulation)
        for length, text, count in ((0, b'', 1), (3, b'pd\0', -1), (3, b'pd\0', 2**28), (3, b'pd\0', 2**31 - 1)):
            self.datagram('TWIN_PD_COMMAND', controller_command_t._get_packed_fingerprint() +
                          struct.pack('>qi', 0, length) + text + struct.pack('>qdiq', 1, 0.0, count, 0))
        self.datagram('TWIN_LOOP', os.urandom(40))
        self.expect(lambda: self.diagnosed('simulation_node: LCM payloads', WARN, '5 refused'), simulation)
        counts = {value.key: value.value for value in self.status['simulation_node: LCM payloads'].values}
        self.assertEqual(counts, {'refused on TWIN_PD_COMMAND': '4', 'refused on TWIN_LOOP': '1'})
        reached = self.steps
        self.expect(lambda: self.steps > reached, simulation)
        self.expect(lambda: self.says(simulation, 'LCM payloads: . refused'), simulation)

    def test_text_is_shown_and_not_obeyed(self):
        self.begin(SLOW)
        terminal = self.start('terminal_node')
        publisher = rospy.Publisher('/twin/alerts', AlertArray, queue_size=1, latch=True)
        self.addCleanup(publisher.unregister)
        self.expect(lambda: self.says(terminal, 'rotor:'), terminal)
        publisher.publish(AlertArray(alerts=[Alert(
            id=1, type='UNSTABLE', system='ro\ntor', severity=2, text='\x1b]0;TITLE\x07\x1b[2J\u202ered\r\nforged')]))
        self.expect(lambda: self.says(terminal, r'raised: \\x1b\]0;TITLE\\x07\\x1b\[2J.*red\\x0d\\x0aforged'), terminal)
        publisher.publish(AlertArray())
        self.expect(lambda: self.says(terminal, r'cleared: ro\\x0ator UNSTABLE'), terminal)
        with open(terminal[1], 'rb') as log:
            self.assertNotRegex(log.read(), b'[\x00-\x09\x0b-\x1f]|\xe2\x80\xae')

    def test_what_silences_is_seen(self):
        self.begin(SLOW)
        self.start('monitor_node')
        terminal = self.start('terminal_node')
        watch = self.start_program(os.environ['WHIRL_TWIN_PROGRAM'], 'watch')
        monitors = []
        self.listen('/twin/monitor', MonitorStatus, monitors.append)
        self.expect(lambda: monitors and self.says(terminal, 'rotor:') and self.says(watch, 'monitor: 0 active alerts'), watch)
        command = alarm_command_t()
        command.command, command.duration = 3, 3600.0
        self.datagram('TWIN_ALARM_COMMANDS', command.encode())
        self.expect(lambda: self.diagnosed('monitor_node: monitor', WARN, 'inhibited by a message on LCM since .* until'))
        self.expect(lambda: ('INHIBITED', 'rotor') in self.alerts)
        self.expect(lambda: monitors[-1].inhibited and 800 < monitors[-1].inhibited[0] <= 900)
        for process in (terminal, watch):
            self.expect(lambda: self.says(process, 'alerts of rotor are inhibited by a message on LCM'), process)
        self.expect(lambda: self.says(terminal, 'ALERTS OF 2 SYSTEMS INHIBITED'), terminal)
        self.assertTrue(call('/monitor_node/inhibit', Inhibit, '', 0.0).success)
        self.expect(lambda: not self.alerts)
        self.expect(lambda: self.says(terminal, 'cleared: rotor INHIBITED'), terminal)

    def test_one_run_of_one_scene_is_watched(self):
        simulation = self.begin(UNSTABLE)
        monitor = self.start('monitor_node', '_source:=lcm')
        self.expect(lambda: self.alerts.get(('UNSTABLE', 'rotor')), monitor)
        raised = self.alerts['UNSTABLE', 'rotor'].id
        self.scene(SLOW, '/other')
        other = self.start('simulation_node', '_realtime:=ignore', '_lcm_prefix:=TWIN_', '__ns:=/other')
        self.expect(lambda: ('DUPLICATE_TWIN', 'twin') in self.alerts, monitor)
        self.assertIn('/other/simulation_node on', self.alerts['DUPLICATE_TWIN', 'twin'].text)
        self.end(other)
        self.expect(lambda: ('DUPLICATE_TWIN', 'twin') not in self.alerts, monitor)
        self.assertEqual(self.alerts['UNSTABLE', 'rotor'].id, raised)
        self.scene(SLOW)  # and nobody starts a simulation with it
        monitor[0].kill()
        monitor[0].wait()
        self.status.clear()
        monitor = self.start('monitor_node')
        self.expect(lambda: self.diagnosed('monitor_node: monitor', ERROR, r'differs from that of the monitor .*shaft\.speed is 58 there, 8 here'),
                    monitor)
        self.end(simulation)
        self.begin(SLOW)  # another run, whose scene it has
        self.expect(lambda: self.says(monitor, 'another run is monitored from now on'), monitor)
        self.expect(lambda: self.diagnosed('monitor_node: monitor', OK, 'no alerts'), monitor)

    def test_bridge_and_displays_keep_to_one_run(self):
        simulation = self.begin(SLOW)
        bridge = self.start('lcm_bridge_node', '_lcm_prefix:=TWIN_', '__ns:=/mirror')
        watch = self.start_program(os.environ['WHIRL_TWIN_PROGRAM'], 'watch')
        terminal = self.start('terminal_node')
        speeds = set()
        self.listen('/mirror/drives/shaft', DriveState, lambda drive: speeds.add(drive.speed))
        self.expect(lambda: self.steps > 4000 and speeds and self.says(terminal, 'rotor:'), simulation, bridge)
        self.scene(UNSTABLE, '/other')
        other = self.start('simulation_node', '_realtime:=ignore', '_lcm_prefix:=TWIN_', '__ns:=/other')
        self.expect(lambda: self.says(watch, r'duplicate publisher: /other/simulation_node on .* ignored'), watch)
        self.expect(lambda: self.left_out() > 1000, bridge)
        self.end(other)
        intruder = self.start('simulation_node', '_realtime:=ignore', '_lcm_url:=', '__name:=intruder')
        self.expect(lambda: self.says(terminal, '/intruder also publishes as this twin, beside /simulation_node'), terminal)
        self.end(intruder)
        self.assertEqual(speeds, {SLOW})
        # One that takes its place is followed.
        self.end(simulation)
        speeds.clear()
        self.begin(UNSTABLE)
        self.expect(lambda: speeds == {UNSTABLE}, bridge)

    def left_out(self):
        status = self.status.get('mirror/lcm_bridge_node: received from LCM')
        return max((int(v.value) for v in status.values if v.key.startswith('ignored, of other')), default=0) if status else 0

    def test_an_input_that_is_set_is_shown(self):
        simulation = self.begin(SLOW)
        self.expect(lambda: self.diagnosed('simulation_node: inputs', OK), simulation)
        self.assertTrue(call('/simulation_node/set_input', SetInput, 'rotor', 'force_x', 3.0, 4.0).success)
        self.expect(lambda: self.diagnosed('simulation_node: inputs', WARN, r'rotor/force_x is 3 by .* since .* until t = '))
        self.expect(lambda: self.diagnosed('simulation_node: inputs', OK), simulation)

    def test_arrays_of_different_lengths(self):
        self.begin(SLOW)
        terminal = self.start('terminal_node')
        publisher = rospy.Publisher('/twin/rotor/orders', OrderState, queue_size=1, latch=True)
        self.addCleanup(publisher.unregister)
        self.expect(lambda: self.says(terminal, 'rotor:') and publisher.get_num_connections() > 0, terminal)
        call('/simulation_node/pause', Trigger)  # its own do not take the place of this one
        orders = OrderState(valid=True, order=[1.0], line_frequency=[40.0])
        orders.header.frame_id = 'rotor'
        publisher.publish(orders)
        self.expect(lambda: self.says(terminal, '/twin/rotor/orders: rejected'), terminal)
        self.assertIsNone(terminal[0].poll())
