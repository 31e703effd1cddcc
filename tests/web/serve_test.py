#!/usr/bin/python3
"""`twin serve` by a client of its protocol: handshakes, values, parameters, commands, and what it refuses.

usage: in_private_network serve_test.py TWIN
"""
import json
import os
import random
import re
import signal
import subprocess
import sys
import tempfile
import unittest

from foxglove_client import PATIENCE, Client, Refused, get

sys.path.append(os.path.join(os.path.dirname(os.path.abspath(__file__)), os.pardir, 'tools'))
from ros_messages import Definition  # noqa: E402

TWIN = sys.argv[1]
SUBPROTOCOLS = ('foxglove.websocket.v1', 'foxglove.sdk.v1')


class Server:
    """A running `twin serve`."""

    def __init__(self, *arguments, scene='demo', port=0):
        self.process = subprocess.Popen([TWIN, 'serve', scene, '--port', str(port), *arguments], stdout=subprocess.PIPE,
                                        stderr=subprocess.PIPE, text=True)
        self.url = self.process.stdout.readline().strip()
        found = re.match(r'http://([\d.]+):(\d+)/(\?token=(\w+))?$', self.url)
        assert found, (self.url, self.process.stderr.read() if not self.url else '')
        self.port = int(found[2])
        self.token = found[4]

    def __enter__(self):
        return self

    def __exit__(self, *unused):
        self.stop()

    def stop(self, how=signal.SIGINT):
        """Its status, and what it wrote to standard error."""
        if self.process.poll() is None:
            self.process.send_signal(how)
        _, errors = self.process.communicate(timeout=PATIENCE)
        return self.process.returncode, errors

    def client(self, **options):
        client = Client(self.port, **options)
        client.greeting()
        return client


def simulated(scene, seconds):
    out = subprocess.run([TWIN, 'simulate', scene, '--duration', str(seconds), '--json'], check=True, capture_output=True)
    return json.loads(out.stdout)


class Paused(unittest.TestCase):
    """Of a twin that does nothing by itself."""

    @classmethod
    def setUpClass(cls):
        cls.server = Server('--paused', '--rate', '0')

    @classmethod
    def tearDownClass(cls):
        cls.server.stop()

    def test_both_subprotocols(self):
        for name in SUBPROTOCOLS:
            with Client(self.server.port, name) as client:
                self.assertEqual(client.head['sec-websocket-protocol'], name)
                info = client.greeting()
                self.assertEqual(set(info['capabilities']),
                                 {'time', 'parameters', 'parametersSubscribe', 'services', 'clientPublish'})
                self.assertEqual(info['supportedEncodings'], ['json'])
        with Client(self.server.port, 'other, foxglove.sdk.v1') as client:
            self.assertEqual(client.head['sec-websocket-protocol'], 'foxglove.sdk.v1')

    def test_other_subprotocols_are_refused(self):
        for name in ('other.v1', None, 'foxglove.websocket.v10'):
            with self.assertRaises(Refused) as refused:
                Client(self.server.port, name)
            status, text = refused.exception.args
            self.assertEqual(status, 400)
            self.assertRegex(text, r'^Sec-WebSocket-Protocol: must be foxglove.sdk.v1 or foxglove.websocket.v1, found [^\n]+$')

    def test_host_and_origin(self):
        port = self.server.port
        for host in (f'127.0.0.1:{port}', f'localhost:{port}', f'LOCALHOST:{port}', f'[::1]:{port}'):
            self.assertEqual(get(port, host=host)[0], 200, host)
            self.server.client(host=host, origin=f'http://{host}').link.close()
        for host in ('evil.example', f'evil.example:{port}', '127.0.0.1', f'127.0.0.1:{port + 1}', f'127.0.0.1.evil:{port}'):
            status, _, text = get(port, host=host)
            self.assertEqual((status, text.count('\n')), (403, 1), host)
            with self.assertRaises(Refused):
                Client(port, host=host)
        for origin in ('http://evil.example', f'https://127.0.0.1:{port}', 'http://localhost', 'null',
                       f'http://localhost:{port + 1}'):
            self.assertEqual(get(port, origin=origin)[0], 403, origin)
            with self.assertRaises(Refused):
                Client(port, origin=origin)

    def test_files(self):
        status, head, text = get(self.server.port)
        self.assertEqual(status, 200)
        self.assertIn('Content-Security-Policy', head)
        names = re.findall(r'(?:src|href)="([\w.]+)"', text)
        self.assertIn('page.js', names)
        for name in names:
            self.assertEqual(get(self.server.port, '/' + name)[0], 200, name)
            for other in re.findall(r'from "\./([\w.]+)"', get(self.server.port, '/' + name)[2]):
                self.assertEqual(get(self.server.port, '/' + other)[0], 200, other)
        for path in ('/../README.md', '/%2e%2e/README.md', '//etc/passwd', '/page.js/', '/no.js'):
            self.assertEqual(get(self.server.port, path)[0], 404, path)
        self.assertEqual(get(self.server.port, method='POST')[0], 405)

    def test_page_requests_nothing_from_elsewhere(self):
        names = re.findall(r'(?:src|href)="([^"]+)"', get(self.server.port)[2])
        for name in names:
            self.assertNotIn('//', name)
            text = get(self.server.port, '/' + name)[2].replace('http://www.w3.org/2000/svg', '')
            self.assertNotRegex(text, r'https?://')

    def test_channels(self):
        with self.server.client() as client:
            for topic in ('rotor/whirl', 'pendulum/pendulum', 'drives/shaft', 'rotor/stability', 'alerts', 'loop', 'monitor',
                          'scene', 'server', 'rotor/picture', 'pendulum/parameters'):
                channel = client.channels[topic]
                self.assertEqual((channel['encoding'], channel['schemaEncoding']), ('json', 'jsonschema'))
                self.assertEqual(json.loads(channel['schema'])['type'], 'object')
            fields = json.loads(client.channels['rotor/whirl']['schema'])['properties']
            self.assertEqual(fields['radius'], {'type': 'number', 'description': 'm'})

    def test_values_are_those_of_the_twin(self):
        with self.server.client() as client:
            self.assertTrue(client.call('reset')['success'])
            client.subscribe('rotor/whirl', 'pendulum/pendulum', 'rotor/picture')
            answer = client.call('step', {'steps': 2000})
            self.assertEqual((answer['success'], answer['step']), (True, 2000))
            whirl = client.of('rotor/whirl', lambda content: content['step'] == 2000)
            pendulum = client.of('pendulum/pendulum', lambda content: content['step'] == 2000)
            end = simulated('demo', 2)['systems']
            self.assertEqual({name: whirl[name] for name in ('x', 'y', 'x_rate', 'y_rate')}, end['rotor']['state'])
            self.assertEqual({'theta': pendulum['angle'][0], 'theta_rate': pendulum['rate'][0]}, end['pendulum']['state'])
            self.assertEqual(whirl['time'], 2.0)
            fields = json.loads(client.channels['rotor/whirl']['schema'])['properties']
            self.assertEqual(set(fields), set(whirl))
            sketch = client.of('rotor/picture', lambda content: content['step'] == 2000)['sketch']
            self.assertEqual(len(sketch['discs']), 1)

    def test_messages_of_ros_have_the_same_values(self):
        with self.server.client() as client:
            client.call('reset')
            names = [topic for topic in client.channels if '/twin/' + topic in client.channels]
            self.assertEqual({'/twin/' + name for name in names} | set(names) | {
                topic for topic in client.channels if topic.endswith('/picture')} | {'scene', 'server'}, set(client.channels))
            client.subscribe(*names, *('/twin/' + name for name in names))
            client.call('step', {'steps': 1500})
            seen = 0
            for name in names:
                channel = client.channels['/twin/' + name]
                self.assertEqual((channel['encoding'], channel['schemaEncoding']), ('ros1', 'ros1msg'))
                definition = Definition(channel['schema'], ros2=False)
                if name in ('rotor/whirl', 'pendulum/pendulum', 'drives/shaft', 'rotor/orders', 'rotor/parameters', 'alerts'):
                    text = client.of(name, lambda content: content.get('step', 1) > 0 or name.endswith('parameters'))
                    read = client.of('/twin/' + name, lambda data: definition.read(data).get('step') == text.get('step'))
                    read = definition.read(read)
                    for field in set(text) & set(read) - {'alerts', 'header'}:
                        value = [x if x == x else None for x in read[field]] if isinstance(read[field], list) else \
                            read[field] if read[field] == read[field] else None
                        self.assertEqual(value, text[field], (name, field))
                        seen += 1
            self.assertGreater(seen, 40)

    def test_published_inputs(self):
        """A force on a cart without a spring: it moves by F t^2 / 2 m."""
        with tempfile.NamedTemporaryFile('w', suffix='.yaml') as scene:
            scene.write('{name: cart, step: 0.001, systems: {cart: {model: mass_spring_damper, inputs: {force: 0.0}, '
                        'parameters: {mass: 2.0, stiffness: 0.0, damping: 0.0}}}}')
            scene.flush()
            self.publish_inputs(scene.name)

    def publish_inputs(self, scene):
        with Server('--paused', '--rate', '0', scene=scene) as server, server.client() as client:
            client.send({'op': 'advertise', 'channels': [{'id': 7, 'topic': '/twin/cart/inputs', 'encoding': 'json',
                                                          'schemaName': ''}]})
            client.subscribe('cart/pendulum')
            client.publish(7, {'input': ['force'], 'value': [3.0], 'duration': 1.0})
            client.call('step', {'steps': 1000})
            self.assertAlmostEqual(client.of('cart/pendulum', lambda content: content['step'] == 1000)['angle'][0], 0.75, 2)
            for content, why in (({'input': ['no'], 'value': [1.0], 'duration': 1.0}, 'input: must be'),
                                 ({'input': ['force'], 'value': [], 'duration': 1.0}, 'must be {"input"'),
                                 ({'input': ['force'], 'value': [1.0], 'duration': -1.0}, 'duration'),
                                 ([], 'must be {"input"')):
                client.publish(7, content)
                self.assertIn(why, client.op('status')['message'])
            client.publish(8, {})
            self.assertIn('advertised', client.op('status')['message'])
            client.send({'op': 'advertise', 'channels': [{'id': 9, 'topic': 'other', 'encoding': 'json', 'schemaName': ''}]})
            self.assertIn('SYSTEM/inputs', client.op('status')['message'])

    def test_stamps_do_not_go_back_in_a_reset(self):
        with self.server.client() as client:
            client.subscribe('rotor/whirl')
            client.call('step', {'steps': 10})
            client.call('reset')
            client.call('step', {'steps': 10})
            client.call('step', {'steps': 1})
            client.of('rotor/whirl', lambda content: content['step'] == 11)
            stamps = [message[2] for message in client.waiting if message[:2] == ('message', 'rotor/whirl')
                      if isinstance(message, tuple)]
            self.assertGreater(len(stamps), 10)
            self.assertEqual(stamps, sorted(stamps))

    def test_parameters(self):
        with self.server.client() as client, self.server.client() as other:
            values = client.parameters()
            self.assertEqual(values['rotor/mass'], 2.0)
            self.assertEqual(client.parameters('rotor/mass', 'no/such'), {'rotor/mass': 2.0})
            other.send({'op': 'subscribeParameterUpdates', 'parameterNames': ['rotor/mass']})
            self.assertEqual(client.set_parameters(rotor__mass=2.5), ({'rotor/mass': 2.5}, None))
            self.assertEqual(other.op('parameterValues')['parameters'],
                             [{'name': 'rotor/mass', 'value': 2.5, 'type': 'float64'}])
            other.subscribe('rotor/parameters')
            change = other.of('rotor/parameters', lambda content: content['changed'] == ['mass'])
            self.assertEqual(change['previous'], [2.0])

            for value, found in ((-1.0, '-1'), (0, '0'), ('heavy', '"heavy"'), (None, 'null'), (True, 'true')):
                after, why = client.set_parameters(rotor__mass=value)
                self.assertEqual(after, {'rotor/mass': 2.5}, value)
                self.assertIn('mass', why)
                self.assertTrue(why.endswith(f'found {found}'), why)
                self.assertNotIn('\n', why)
            after, why = client.set_parameters(rotor__mas=1.0)
            self.assertEqual((after, why), ({}, "name: must be a parameter of the twin, found 'rotor/mas'; did you mean "
                                                "'rotor/mass'?"))
            # All of a request, or nothing.
            after, why = client.set_parameters(rotor__mass=3.0, rotor__damping=-1.0)
            self.assertEqual(after['rotor/mass'], 2.5)
            self.assertIn('damping', why)
            after, why = client.set_parameters(rotor__mass=3.0, pendulum__mass=1.0)
            self.assertEqual(after['rotor/mass'], 2.5)
            self.assertIn('one system', why)
            client.call('reset')
            client.subscribe('rotor/parameters')
            client.of('rotor/parameters', lambda content: content['values'][content['names'].index('mass')] == 2.0)

    def test_services(self):
        with self.server.client() as client:
            moved = client.call('set_speed', {'drive': 'shaft', 'speed': 5.0, 'max_acceleration': 10.0, 'max_jerk': 0.0})
            self.assertTrue(moved['success'], moved)
            for service, request, why in (
                    ('set_speed', {'drive': 'shaf', 'speed': 5.0, 'max_acceleration': 1.0, 'max_jerk': 0.0},
                     "drive: must be a drive of the scene, found 'shaf'; did you mean 'shaft'?"),
                    ('set_speed', {'drive': 'shaft', 'speed': 1e9, 'max_acceleration': 1.0, 'max_jerk': 0.0}, 'speed must be within'),
                    ('set_input', {'system': 'rotor', 'input': 'torque', 'value': 1.0, 'duration': 1.0}, 'input: must be'),
                    ('set_real_time_factor', {'factor': -1}, 'real_time_factor: must be'),
                    ('acknowledge', {'system': 'roto', 'type': ''}, 'system: must be a system of the scene'),
                    ('inhibit', {'system': 'rotor', 'duration': -5}, 'duration: must be from 0 to 3600 s')):
                answer = client.call(service, request)
                self.assertFalse(answer['success'], request)
                self.assertIn(why, answer['message'])
            for service, request in (('step', {}), ('step', {'steps': -1}), ('step', {'steps': 1.5}), ('step', [1]),
                                     ('set_speed', {'drive': 3}), ('no_service', {})):
                self.assertIsInstance(client.call(service, request), str, (service, request))
            client.call('reset')

    def test_clients_are_limited(self):
        clients = [self.server.client() for _ in range(8)]
        with self.assertRaises(Refused) as refused:
            self.server.client()
        self.assertEqual(refused.exception.args[0], 503)
        for client in clients:
            client.link.close()

    def test_malformed_messages(self):
        numbers = random.Random(1)
        with self.server.client() as client:
            for text in ('', '{', '[]', '1', '"a"', '{"op":1}', '{"op":"no"}', '[' * 30000, '{"op":"subscribe"}' * 2,
                         '{"op":"subscribe","subscriptions":[1,{"id":-1},{"id":1,"channelId":99999}]}',
                         '{"op":"unsubscribe","subscriptionIds":["x",7]}', '{"op":"setParameters","parameters":[1,{}]}',
                         '{"op":"getParameters","parameterNames":[1]}', '{"op":"setParameters","parameters":{"a":1}}'):
                client.send(text)
            for payload in (b'', b'\x02', b'\x02' + b'\xff' * 12, b'\x02' + b'\xff' * 20, b'\x01abc', b'\x02' + bytes(12)):
                client.send(payload, 2)
            self.assertIn('rotor/mass', client.parameters())
            for _ in range(300):
                client.send(bytes(numbers.randrange(256) for _ in range(numbers.randrange(60))), 2)
            self.assertIn('rotor/mass', client.parameters())

    def test_malformed_frames(self):
        numbers = random.Random(2)
        for i in range(int(os.environ.get('WHIRL_TWIN_FRAMES', 1000))):
            client = Client(self.server.port)
            with client:
                garbage = bytes(numbers.randrange(256) for _ in range(numbers.randrange(1, 200)))
                client.link.sendall(garbage if i % 2 else bytes([0x81, 0x80 | numbers.randrange(126)]) + garbage)
        with self.server.client() as client:
            client.subscribe('server')
            self.assertGreater(client.of('server', lambda counts: counts['malformed'] > 0)['malformed'], 0)
        self.assertIsNone(self.server.process.poll())

    def test_too_long_message(self):
        with self.server.client() as client:
            try:
                client.send('x' * 70000)
                with self.assertRaises((ConnectionError, OSError)):
                    client.op('never')
            except OSError:
                pass  # closed while it was sent
        with self.server.client() as client:
            self.assertIn('rotor/mass', client.parameters())


class Running(unittest.TestCase):
    def test_an_alarm_and_its_acknowledgement(self):
        with Server('--real-time-factor', '0') as server, server.client() as client:
            client.subscribe('alerts')
            alerts = client.of('alerts', lambda content: content['alerts'])['alerts']
            system, kind = alerts[0]['system'], alerts[0]['type']
            self.assertTrue(client.call('pause')['success'])
            answer = client.call('acknowledge', {'system': '', 'type': ''})
            self.assertTrue(answer['success'], answer)
            self.assertIn((system, kind), {(alert['system'], alert['type']) for alert in alerts})

    def test_stability(self):
        with Server() as server, server.client() as client:
            client.subscribe('rotor/stability')
            self.assertGreater(client.of('rotor/stability', lambda margin: margin['decay_rate'])['decay_rate'], 0.0)

    def test_a_client_that_never_reads_costs_a_counter(self):
        with Server('--rate', '0', '--real-time-factor', '0') as server, server.client() as other:
            with server.client(receive_buffer=4096) as client:
                client.subscribe(*(topic for topic in client.channels))
                other.subscribe('server', 'loop')
                before = other.of('loop')['step']
                other.of('server', lambda counts: counts['dropped'] > 0)
                other.of('loop', lambda loop: loop['step'] > before)
                self.assertTrue(other.call('set_real_time_factor', {'factor': 1.0})['success'])
            other.of('server', lambda counts: counts['clients'] == 1)

    def test_pause_interrupts_steps(self):
        with Server('--paused') as server, server.client() as client, server.client() as other:
            client.send(b'\x02' + client.services['step'].to_bytes(4, 'little') + (77).to_bytes(4, 'little') +
                        b'\x04\0\0\0json{"steps":1000000000}', 2)
            other.subscribe('loop')
            other.of('loop', lambda loop: loop['step'] > 0)
            self.assertTrue(other.call('pause')['success'])
            answer = client.until(lambda message: isinstance(message, tuple) and message[:1] == ('answer',))[3]
            self.assertFalse(answer['success'])
            self.assertIn('interrupted', answer['message'])

    def test_ends_by_ctrl_c(self):
        for how in (signal.SIGINT, signal.SIGTERM):
            server = Server()
            with server.client() as client:
                client.subscribe('rotor/whirl')
                client.of('rotor/whirl')
                status, errors = server.stop(how)
                self.assertEqual(status, 0, errors)
                self.assertRegex(errors, r'^twin serve: stopped after \d+ steps\n$')
                with self.assertRaises(ConnectionError):
                    while True:
                        client.message()

    def test_port_in_use(self):
        with Server('--paused') as server:
            second = subprocess.run([TWIN, 'serve', 'demo', '--port', str(server.port)], capture_output=True, text=True,
                                    timeout=PATIENCE)
            self.assertEqual(second.returncode, 1)
            self.assertEqual(second.stderr, f'twin: port: {server.port} is in use on 127.0.0.1; 0 takes any free one\n')

    def test_wrong_options(self):
        for arguments, why in ((['--port', '70000'], '--port: must be from 0'), (['--rate', '-1'], '--rate: must be'),
                               (['--address', 'nowhere'], 'address: must be an IP address'),
                               (['--real-time-factor', '-1'], 'real_time_factor: must be')):
            run = subprocess.run([TWIN, 'serve', 'demo', *arguments], capture_output=True, text=True,
                                 timeout=PATIENCE)
            self.assertEqual(run.returncode, 2, run)
            self.assertIn(why, run.stderr)

    def test_read_only(self):
        with Server('--read-only', '--paused') as server, server.client() as client:
            self.assertEqual(client.services, {})
            after, why = client.set_parameters(rotor__mass=3.0)
            self.assertEqual((after, why), ({'rotor/mass': 2.0}, 'the server is read-only: no parameter can be set'))
            client.services = {'reset': 2}
            self.assertEqual(client.call('reset'), 'the server is read-only: it has no services')

    def test_token(self):
        with Server('--paused', '--address', '0.0.0.0') as server:
            self.assertRegex(server.token, r'^[0-9a-f]{32}$')
            wrong = ('/', '/?token=', '/?token=' + server.token[:-1], '/?token=' + server.token + '0',
                     '/?token=' + '0' * 32, '/?other=' + server.token)
            for path in wrong:
                self.assertEqual(get(server.port, path)[0], 403, path)
                with self.assertRaises(Refused):
                    Client(server.port, path=path)
            path = '/?token=' + server.token
            self.assertEqual(get(server.port, path)[0], 200)
            with Client(server.port, path=path, origin=f'http://127.0.0.1:{server.port}') as client:
                self.assertEqual(client.greeting()['op'], 'serverInfo')
            with self.assertRaises(Refused):
                Client(server.port, path=path, origin='http://evil.example')

    def test_another_page_may_connect(self):
        origin = 'http://localhost:8080'
        with Server('--paused', '--origin', origin) as server:
            server.client(origin=origin).link.close()
            with self.assertRaises(Refused):
                Client(server.port, origin='http://localhost:8081')

    def test_shipped_scenes(self):
        for scene in ('compressor', 'double_pendulum', 'swing_up', 'levitation', 'sommerfeld', 'linear_system', 'tolerances'):
            with self.subTest(scene), Server(scene=scene) as server, server.client() as client:
                pictures = [topic for topic in client.channels if topic.endswith('/picture')]
                client.subscribe(*pictures)
                for topic in pictures:
                    self.assertEqual(client.of(topic, lambda content: content['samples']['time'])['stopped'], '')


if __name__ == '__main__':
    unittest.main(argv=sys.argv[:1])
