"""web_node serves the twin that runs: its messages are the topics', its commands those of the services."""
import os
import re
import socket
import sys

import rospy
from whirl_twin.msg import AlertArray, ParameterChange, WhirlState

from node_trial import PACKAGE, PATIENCE, SCENES, NodeTrial, load_parameters, load_scene, wait_until

sys.path += [os.path.join(PACKAGE, 'tests', 'web'), os.path.join(PACKAGE, 'tests', 'tools')]
from foxglove_client import Client, Refused, get  # noqa: E402
from ros_messages import Definition  # noqa: E402


class Web(NodeTrial):
    def setUp(self):
        super().setUp()
        self.whirls, self.parameters, self.alerts = {}, [], []
        self.listen('/twin/rotor/whirl', WhirlState, lambda m: self.whirls.update({m.step: m}))
        self.listen('/twin/rotor/parameters', ParameterChange, self.parameters.append)
        self.listen('/twin/alerts', AlertArray, lambda m: setattr(self, 'alerts', m.alerts))

    def twin(self, *arguments, scene='demo', **settings):
        """A simulation, its monitor and the server; returns the port."""
        load_scene(os.path.join(SCENES, scene + '.yaml'))
        load_parameters(os.path.join(PACKAGE, 'config', 'monitor.yaml'), '/monitor_node')
        self.simulation = self.start('simulation_node', '_realtime:=ignore', *arguments)
        self.monitor = self.start('monitor_node')
        for service in ('/simulation_node/set_parameter', '/simulation_node/pause', '/monitor_node/acknowledge'):
            rospy.wait_for_service(service, PATIENCE)
        return self.web(**settings)

    def web(self, **settings):
        self.node = self.start('web_node', *(f'_{name}:={value}' for name, value in {'port': 0, **settings}.items()))
        self.assertTrue(wait_until(lambda: self.says(self.node, r'open http://127\.0\.0\.1:\d+/')), self.log(self.node))
        return int(self.says(self.node, r'open http://127\.0\.0\.1:(\d+)/')[1])

    def client(self, port, **options):
        client = Client(port, **options)
        self.addCleanup(client.link.close)
        client.greeting()
        return client

    def test_messages_are_those_of_the_topics(self):
        port = self.twin('_paused:=true', rate=0)
        client = self.client(port)
        client.subscribe('rotor/whirl', '/twin/rotor/whirl', 'rotor/picture', 'loop', 'rotor/parameters')
        client.of('loop')  # the node listens
        self.assertEqual(client.of('rotor/parameters')['values'], list(self.parameters[-1].values))
        self.assertEqual(client.call('step', {'steps': 200}), {'success': True, 'message': '200 steps done', 'step': 200})
        json = client.of('rotor/whirl', lambda content: content['step'] == 200)
        self.assertTrue(wait_until(lambda: 200 in self.whirls))
        topic = self.whirls[200]
        for name in ('time', 'radius', 'phase', 'x', 'y', 'x_rate', 'y_rate', 'speed', 'shaft_angle'):
            self.assertEqual(json[name], getattr(topic, name), name)
        channel = client.channels['/twin/rotor/whirl']
        self.assertEqual((channel['encoding'], channel['schemaName'], channel['schemaEncoding'], channel['schema']),
                         ('ros1', 'whirl_twin/WhirlState', 'ros1msg', WhirlState._full_text))
        definition = Definition(channel['schema'], ros2=False)
        raw = client.of('/twin/rotor/whirl', lambda data: definition.read(data)['step'] == 200)
        message = WhirlState()
        message.deserialize(raw)
        message.header.seq = topic.header.seq  # of the connection
        self.assertEqual(str(message), str(topic))  # a NaN is no NaN's equal
        picture = client.of('rotor/picture', lambda content: content['step'] == 200)
        self.assertEqual((picture['time'], picture['stopped'], len(picture['sketch']['discs'])), (topic.time, '', 1))
        self.assertEqual(get(port)[0], 200)

    def test_commands_go_to_the_services(self):
        port = self.twin()
        client, other = self.client(port), self.client(port)
        other.send({'op': 'subscribeParameterUpdates', 'parameterNames': ['rotor/mass']})
        self.assertEqual(client.set_parameters(rotor__mass=2.5), ({'rotor/mass': 2.5}, None))
        self.assertTrue(wait_until(lambda: self.parameters[-1].values[self.parameters[-1].names.index('mass')] == 2.5))
        self.assertEqual(self.parameters[-1].changed, ['mass'])
        other.until(lambda m: isinstance(m, dict) and m.get('parameters') == [
            {'name': 'rotor/mass', 'value': 2.5, 'type': 'float64'}])
        after, why = client.set_parameters(rotor__mass=-1.0)
        self.assertEqual(after, {'rotor/mass': 2.5})
        self.assertRegex(why, r'mass.*must be .*> 0.*found -1')
        answer = client.call('set_speed', {'drive': 'shaf', 'speed': 5.0, 'max_acceleration': 1.0, 'max_jerk': 0.0})
        self.assertEqual((answer['success'], answer['message']),
                         (False, "drive: must be a drive of the scene, found 'shaf'; did you mean 'shaft'?"))
        client.send({'op': 'advertise', 'channels': [{'id': 1, 'topic': '/twin/rotor/inputs', 'encoding': 'json',
                                                      'schemaName': ''}]})
        client.publish(1, {'input': ['no_force'], 'value': [1.0], 'duration': 1.0})
        self.assertRegex(client.op('status')['message'], '^input: must be .*no_force')
        self.assertTrue(client.call('pause')['success'])
        client.subscribe('loop')
        client.of('loop', lambda loop: loop['paused'])

    def test_alarms_and_a_monitor_that_dies(self):
        client = self.client(self.twin('_real_time_factor:=0'))
        client.subscribe('alerts', '/twin/alerts', 'server')
        raised = client.of('alerts', lambda content: content['alerts'])['alerts']
        self.assertTrue(client.call('pause')['success'])
        answer = client.call('acknowledge', {'system': '', 'type': ''})
        self.assertTrue(answer['success'], answer)
        client.of('alerts', lambda content: content['alerts'] and all(a['acknowledged'] for a in content['alerts']))
        self.assertTrue(wait_until(lambda: self.alerts and all(alert.acknowledged for alert in self.alerts)))
        self.assertTrue({alert['type'] for alert in raised} & {alert.type for alert in self.alerts})
        answer = client.call('acknowledge', {'system': 'roto', 'type': ''})
        self.assertEqual((answer['success'], answer['message'][:34]), (False, 'system: must be a system of the sc'))
        client.of('server', lambda counts: counts['silence'] == '')
        self.end(self.monitor)
        client.of('server', lambda counts: re.match('no message from the monitor for', counts['silence']))
        self.assertRegex(client.call('reset_alarms')['message'], '^/monitor_node/reset_alarms does not answer')
        self.end(self.simulation)
        client.of('server', lambda counts: re.match('no message from the twin for', counts['silence']))

    def test_another_scene_is_served_on_the_same_port(self):
        port = self.twin('_paused:=true')
        client = self.client(port)
        self.assertIn('rotor/whirl', client.channels)
        load_scene(os.path.join(SCENES, 'double_pendulum.yaml'))
        self.assertTrue(wait_until(lambda: len(re.findall(f'open http://127.0.0.1:{port}/', self.log(self.node))) == 2))
        with self.assertRaises(ConnectionError):
            client.op('never')
        self.assertNotIn('rotor/whirl', self.client(port).channels)

    def test_read_only_and_tokens(self):
        port = self.twin('_paused:=true', read_only='true', token='0123456789abcdef')
        with self.assertRaises(Refused):
            Client(port)
        client = self.client(port, path='/?token=0123456789abcdef')
        self.assertEqual(client.services, {})
        self.assertEqual(client.set_parameters(rotor__mass=3.0)[1], 'the server is read-only: no parameter can be set')
        for arguments, why in ((('_address:=0.0.0.0',), r'/web_node/token: must be at least 16 letters.*found none'),
                               (('_token:=short',), 'found 5 characters'), (('_port:=70000',), 'from 0 to 65535'),
                               (('_prot:=1',), 'unknown parameter')):
            rospy.delete_param('/web_node')
            self.end(self.node)
            self.node = self.start('web_node', *arguments)
            self.assertEqual(self.node[0].wait(30), 2)
            self.assertRegex(self.log(self.node), why)

    def test_a_port_in_use(self):
        with socket.socket() as taken:
            taken.bind(('127.0.0.1', 0))
            taken.listen()
            port = taken.getsockname()[1]
            load_scene(os.path.join(SCENES, 'demo.yaml'))
            node = self.start('web_node', f'_port:={port}')
            self.assertEqual(node[0].wait(30), 1)
            self.assertIn(f'port: {port} is in use on 127.0.0.1', self.log(node))
