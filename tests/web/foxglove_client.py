"""A client of Foxglove's WebSocket protocol, of the standard library only, for tests."""

import base64
import hashlib
import json
import os
import socket
import struct
import time

PATIENCE = 60.0  # s
TEXT, BINARY, CLOSE, PING, PONG = 1, 2, 8, 9, 10
GUID = "258EAFA5-E914-47DA-95CA-C5AB0DC85B11"


class Refused(Exception):
    """The server answered the handshake with another status; its arguments are the status and the body."""


def request(port, lines, host="127.0.0.1"):
    """Sends an HTTP request of these lines; returns the socket, the status, the header and what follows it."""
    link = socket.create_connection((host, port), timeout=PATIENCE)
    link.sendall(("\r\n".join(lines) + "\r\n\r\n").encode())
    data = b""
    while b"\r\n\r\n" not in data:
        part = link.recv(65536)
        if not part:
            break
        data += part
    head, _, rest = data.partition(b"\r\n\r\n")
    return link, int(head.split(b" ", 2)[1]), head.decode(), rest


def get(port, path="/", host=None, origin=None, method="GET"):
    """The status, the header and the body of a file."""
    lines = [f"{method} {path} HTTP/1.1", f"Host: {host or f'127.0.0.1:{port}'}", "Connection: close"]
    lines += [f"Origin: {origin}"] if origin else []
    link, status, head, body = request(port, lines)
    with link:
        while part := link.recv(65536):
            body += part
    return status, head, body.decode()


class Client:
    """A connection; messages wait in order until they are taken."""

    def __init__(self, port, subprotocol="foxglove.websocket.v1", host=None, origin=None, path="/", receive_buffer=None):
        key = base64.b64encode(os.urandom(16)).decode()
        lines = [f"GET {path} HTTP/1.1", f"Host: {host or f'127.0.0.1:{port}'}", "Upgrade: websocket",
                 "Connection: Upgrade", f"Sec-WebSocket-Key: {key}", "Sec-WebSocket-Version: 13"]
        lines += [f"Sec-WebSocket-Protocol: {subprotocol}"] if subprotocol else []
        lines += [f"Origin: {origin}"] if origin else []
        self.link, status, head, self.data = request(port, lines)
        if status != 101:
            while part := self.link.recv(65536):
                self.data += part
            self.link.close()
            raise Refused(status, self.data.decode().strip())
        if receive_buffer:
            self.link.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, receive_buffer)
        self.head = {name.lower(): value for name, _, value in
                     (line.partition(": ") for line in head.split("\r\n")[1:])}
        accept = base64.b64encode(hashlib.sha1((key + GUID).encode()).digest()).decode()
        assert self.head["sec-websocket-accept"] == accept, head
        self.channels, self.services, self.subscriptions = {}, {}, {}
        self.calls = 0
        self.waiting = []

    def __enter__(self):
        return self

    def __exit__(self, *unused):
        self.link.close()

    # Frames

    def read(self, count):
        while len(self.data) < count:
            part = self.link.recv(65536)
            if not part:
                raise ConnectionError("the server closed the connection")
            self.data += part
        out, self.data = self.data[:count], self.data[count:]
        return out

    def frame(self):
        """The opcode and the payload of the next message; pings are answered."""
        while True:
            first, second = self.read(2)
            length = second & 0x7F
            assert first & 0x80 and not second & 0x80, "one frame a message, not masked"
            if length == 126:
                length, = struct.unpack(">H", self.read(2))
            elif length == 127:
                length, = struct.unpack(">Q", self.read(8))
            payload = self.read(length)
            if first & 0x0F == PING:
                self.send(payload, PONG)
                continue
            return first & 0x0F, payload

    def send(self, payload, opcode=TEXT):
        if not isinstance(payload, bytes):
            payload = (payload if isinstance(payload, str) else json.dumps(payload)).encode()
        size = len(payload)
        head = bytes([0x80 | opcode])
        head += bytes([0x80 | size]) if size < 126 else bytes([0xFE]) + struct.pack(">H", size) if size < 65536 \
            else bytes([0xFF]) + struct.pack(">Q", size)
        mask = os.urandom(4)
        self.link.sendall(head + mask + bytes(byte ^ mask[i % 4] for i, byte in enumerate(payload)))

    # Messages

    def message(self):
        """The next message: the JSON object of a text, or a tuple of a binary one."""
        opcode, payload = self.frame()
        if opcode == CLOSE:
            raise ConnectionError("the server closed the connection")
        if opcode == TEXT:
            return json.loads(payload)
        if payload[0] == 1:
            subscription, stamp = struct.unpack_from("<IQ", payload, 1)
            topic, content = self.subscriptions[subscription], payload[13:]
            is_json = self.channels[topic]["encoding"] == "json"
            return "message", topic, stamp, json.loads(content) if is_json else content
        if payload[0] == 2:
            return "time", struct.unpack_from("<Q", payload, 1)[0]
        service, call, length = struct.unpack_from("<III", payload, 1)
        assert payload[13:13 + length] == b"json"
        return "answer", service, call, json.loads(payload[13 + length:])

    def until(self, wanted):
        """The first message that is wanted; others wait."""
        for i, message in enumerate(self.waiting):
            if wanted(message):
                return self.waiting.pop(i)
        end = time.monotonic() + PATIENCE
        while time.monotonic() < end:
            message = self.message()
            if wanted(message):
                return message
            self.waiting.append(message)
        raise TimeoutError

    def op(self, name):
        return self.until(lambda message: isinstance(message, dict) and message["op"] == name)

    def greeting(self):
        """Takes what the server sends first; returns its serverInfo."""
        info = self.op("serverInfo")
        self.channels = {channel["topic"]: channel for channel in self.op("advertise")["channels"]}
        if "services" in info["capabilities"]:
            self.services = {service["name"]: service["id"] for service in self.op("advertiseServices")["services"]}
        return info

    def subscribe(self, *topics):
        for topic in topics:
            number = len(self.subscriptions) + 100
            self.subscriptions[number] = topic
            self.send({"op": "subscribe",
                       "subscriptions": [{"id": number, "channelId": self.channels[topic]["id"]}]})

    def of(self, topic, wanted=lambda content: True):
        """The content of the first message on a topic that is wanted."""
        return self.until(lambda message: message[:2] == ("message", topic) and wanted(message[3])
                          if isinstance(message, tuple) else False)[3]

    def call(self, service, request=None):
        """The answer of a service, or the text of its failure."""
        self.calls += 1
        call = self.calls
        self.send(struct.pack("<BIII", 2, self.services.get(service, 999), call, 4) + b"json" +
                  json.dumps(request or {}).encode(), BINARY)
        answer = self.until(lambda message: message[:1] == ("answer",) and message[2] == call
                            if isinstance(message, tuple)
                            else message["op"] == "serviceCallFailure" and message["callId"] == call)
        return answer[3] if isinstance(answer, tuple) else answer["message"]

    def publish(self, number, content):
        """A message on a channel that the client has advertised."""
        self.send(struct.pack("<BI", 1, number) + json.dumps(content).encode(), BINARY)

    def parameters(self, *names):
        self.calls += 1
        self.send({"op": "getParameters", "parameterNames": list(names), "id": f"get {self.calls}"})
        return self.values(f"get {self.calls}")

    def set_parameters(self, **values):
        """Sets parameters by name, with __ for /; returns the values afterwards and the complaint, or none."""
        self.calls += 1
        self.send({"op": "setParameters", "id": f"set {self.calls}",
                   "parameters": [{"name": name.replace("__", "/"), "value": value} for name, value in values.items()]})
        values = self.values(f"set {self.calls}")
        complaints = [message for message in self.waiting if isinstance(message, dict) and message["op"] == "status"]
        self.waiting = [message for message in self.waiting if message not in complaints]
        return values, complaints[0]["message"] if complaints else None

    def values(self, number):
        answer = self.until(lambda message: isinstance(message, dict) and message["op"] == "parameterValues"
                            and message.get("id") == number)
        return {one["name"]: one["value"] for one in answer["parameters"]}
