"""Alarms leave the twin: relays, a command, an HTTP server and an MQTT broker receive what a real monitor raises, also
where the receiver fails at first, and a silent monitor is an event."""
import http.server
import json
import os
import shutil
import socket
import subprocess
import threading
import unittest

import rospy
from std_msgs.msg import Bool

from node_trial import TRIAL_SCENES, WARN, NodeTrial, load_scene, wait_until
from not_ok_test import LEVEL, NARROW, WIDE, Machine
from whirl_twin.msg import WhirlState


def free_port():
    with socket.socket() as one:
        one.bind(('127.0.0.1', 0))
        return one.getsockname()[1]


class Receiver(http.server.ThreadingHTTPServer):
    """Answers 503 as long as `fails`."""

    def __init__(self):
        receiver = self
        self.fails = True
        self.refused = 0
        self.events = []

        class Handler(http.server.BaseHTTPRequestHandler):
            def do_POST(self):
                event = json.loads(self.rfile.read(int(self.headers['Content-Length'])))
                if receiver.fails:
                    receiver.refused += 1
                else:
                    receiver.events.append(event)
                self.send_response(503 if receiver.fails else 204)
                self.end_headers()

            def log_message(self, *_):
                pass

        super().__init__(('127.0.0.1', 0), Handler)
        threading.Thread(target=self.serve_forever, daemon=True).start()


class AlarmOutputs(NodeTrial):
    def setUp(self):
        super().setUp()
        load_scene(os.path.join(TRIAL_SCENES, 'run_ups.yaml'))
        rospy.set_param('/monitor_node/amplitude', {'rotor': {'danger': LEVEL}})
        self.relays = {}
        for name in ('warning', 'danger', 'monitor_ok'):
            self.listen('/twin/relays/' + name, Bool, lambda m, name=name: self.relays.update({name: m.data}))
        self.monitor = self.start('monitor_node')
        self.machine = Machine(self.publisher('/twin/rotor/whirl', WhirlState, 100))
        self.machine.start()
        self.addCleanup(self.stop_machine)

    def stop_machine(self):
        self.machine.over = True
        self.machine.join()

    def start_outputs(self, **parameters):
        rospy.set_param('/alarm_output_node', parameters)
        return self.start('alarm_output_node')

    def kinds(self, events):
        return [(event['event'], event.get('type', '')) for event in events]

    def test_relays_command_and_http_receive_what_the_monitor_raises(self):
        receiver = Receiver()
        self.addCleanup(receiver.shutdown)
        lines = self.path('events')
        self.start_outputs(command="sh -c 'cat >> %s'" % lines, monitor_timeout=2.0,
                           url='http://127.0.0.1:%d/alarms' % receiver.server_port)

        def written():
            if not os.path.exists(lines):
                return []
            with open(lines) as file:
                return [json.loads(line) for line in file]

        self.assertTrue(wait_until(lambda: self.relays.get('monitor_ok')))
        self.machine.radius = WIDE
        raised = [('raised', 'WHIRL_AMPLITUDE')]
        self.assertTrue(wait_until(lambda: self.kinds(written()) == raised), written())
        self.assertTrue(wait_until(lambda: self.relays['danger'] and self.relays['warning']))
        event = written()[0]
        self.assertEqual((event['system'], event['severity'], event['twin']), ('rotor', 'danger', '/twin'))
        self.assertGreater(event['amplitude'], LEVEL)
        self.assertIsNone(event['critical_speed'])
        self.assertRegex(event['wall'], r'^20\d\d-\d\d-\d\dT.*\+00:00$')
        # The server fails: the event waits, and the others do not.
        self.assertTrue(wait_until(lambda: receiver.refused > 1))
        self.assertTrue(wait_until(lambda: self.diagnosed('alarm_output_node: HTTP', WARN, '503')))
        self.machine.radius = NARROW
        both = raised + [('cleared', 'WHIRL_AMPLITUDE')]
        self.assertTrue(wait_until(lambda: self.kinds(written()) == both), written())
        self.assertTrue(wait_until(lambda: not self.relays['danger']))
        receiver.fails = False
        self.assertTrue(wait_until(lambda: self.kinds(receiver.events) == both), receiver.events)
        # The monitor ends without a word, and comes back.
        self.monitor[0].kill()
        self.assertTrue(wait_until(lambda: self.kinds(written()) == both + [('monitor_silent', '')]), written())
        self.assertTrue(wait_until(lambda: not self.relays['monitor_ok']))
        self.start('monitor_node')
        self.assertTrue(wait_until(lambda: self.relays['monitor_ok']))
        self.assertTrue(wait_until(lambda: self.kinds(written())[3:] == [('monitor_back', '')]), written())

    @unittest.skipUnless(shutil.which('mosquitto', path=os.environ['PATH'] + ':/usr/sbin'), 'needs mosquitto')
    def test_mqtt_has_each_alarm_retained(self):
        import paho.mqtt.client as mqtt
        port = free_port()
        settings = self.path('mosquitto.conf')
        with open(settings, 'w') as file:
            file.write('listener %d 127.0.0.1\nallow_anonymous true\n' % port)
        outputs = self.start_outputs(mqtt_host='127.0.0.1', mqtt_port=port)  # before there is a broker
        self.machine.radius = WIDE
        self.assertTrue(wait_until(lambda: self.relays.get('danger')))
        self.start_program(shutil.which('mosquitto', path=os.environ['PATH'] + ':/usr/sbin'), '-c', settings)
        received = {}
        client = mqtt.Client()
        client.on_connect = lambda *_: client.subscribe('whirl_twin/#', qos=1)
        client.on_message = lambda _, __, message: received.update({message.topic: message.payload.decode()})
        client.connect_async('127.0.0.1', port)
        client.loop_start()
        self.addCleanup(client.loop_stop)
        alarm = 'whirl_twin/twin/alerts/rotor/WHIRL_AMPLITUDE'
        self.assertTrue(wait_until(lambda: alarm in received), received)
        self.assertEqual(json.loads(received[alarm])['event'], 'raised')
        self.assertEqual(received['whirl_twin/twin/status'], 'online')
        outputs[0].kill()
        self.assertTrue(wait_until(lambda: received['whirl_twin/twin/status'] == 'offline'), received)

    def test_wrong_parameters_are_reported_together(self):
        process = self.start_outputs(url='ftp://x', least_severity='loud', queue=0, relay=1, mqtt_port='a')
        self.assertEqual(process[0].wait(30), 2)
        self.assertEqual(self.log(process).splitlines(), [
            'alarm_output_node: ~relay: unknown parameter',
            "alarm_output_node: ~url: must be an address that begins with http:// or https://, found 'ftp://x'",
            "alarm_output_node: ~mqtt_port: must be a port from 1 to 65535, found 'a'",
            "alarm_output_node: ~least_severity: must be info, warning or danger, found 'loud'",
            'alarm_output_node: ~queue: must be a number of events from 1 to 100000, found 0'])
