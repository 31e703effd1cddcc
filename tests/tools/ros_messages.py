"""Reads messages of ROS 1 (as its serialization has them) and of ROS 2 (CDR, little-endian) by their definitions, as the
specifications state them: ros1msg and ros2msg texts of several messages, with lines of = between. It shares nothing with the
writers."""
import re
import struct

NUMBERS = {'bool': '?', 'byte': 'b', 'char': 'B', 'int8': 'b', 'uint8': 'B', 'int16': 'h', 'uint16': 'H', 'int32': 'i',
           'uint32': 'I', 'int64': 'q', 'uint64': 'Q', 'float32': 'f', 'float64': 'd'}
ROS1_ONLY = {'time': [('secs', 'uint32', None), ('nsecs', 'uint32', None)],
             'duration': [('secs', 'int32', None), ('nsecs', 'int32', None)]}


class Definition:
    def __init__(self, text, ros2):
        parts = re.split(r'^=+\n', text, flags=re.MULTILINE)
        self.types = {'': self.fields(parts[0])}
        for part in parts[1:]:
            name, _, body = part.partition('\n')
            assert name.startswith('MSG: '), name
            self.types[name[5:].strip()] = self.fields(body)
        self.ros2 = ros2

    @staticmethod
    def fields(text):
        """(name, type, None: one, 0: a list, n: as many)"""
        found = []
        for line in text.splitlines():
            line = line.split('#')[0].strip()
            if line and '=' not in line:
                kind, name = line.split()
                array = re.fullmatch(r'(.+)\[(\d*)\]', kind)
                found.append((name, array[1] if array else kind, int(array[2] or 0) if array else None))
        return found

    def read(self, data):
        """Names and values; all of the bytes must be read."""
        self.data, self.at, self.begin = data, 0, 0
        if self.ros2:
            assert data[:2] == b'\0\1', 'CDR, little-endian'
            self.at = self.begin = 4
        message = self.message('', '')
        assert self.at == len(data), f'{len(data) - self.at} bytes are left'
        return message

    def message(self, name, package):
        if not self.ros2 and name in ROS1_ONLY:
            fields = ROS1_ONLY[name]
        else:
            if name == 'Header' and not self.ros2:
                name = 'std_msgs/Header'
            full = next(known for known in self.types if known in (name, package + name) or (name and known.endswith('/' + name)))
            fields, package = self.types[full], full.partition('/')[0] + '/'
        return {field: self.value(kind, count, package) for field, kind, count in fields}

    def value(self, kind, count, package):
        if count is None:
            return self.one(kind, package)
        return [self.one(kind, package) for _ in range(count or self.number('I'))]

    def one(self, kind, package):
        if kind in NUMBERS:
            return self.number(NUMBERS[kind])
        if kind == 'string':
            length = self.number('I')
            text = self.data[self.at:self.at + length]
            assert len(text) == length
            self.at += length
            if self.ros2:
                assert text.endswith(b'\0')
                text = text[:-1]
            return text.decode()
        return self.message(kind, package)

    def number(self, letter):
        size = struct.calcsize('<' + letter)
        if self.ros2:
            padding = -(self.at - self.begin) % size
            assert self.data[self.at:self.at + padding] == bytes(padding)
            self.at += padding
        number, = struct.unpack_from('<' + letter, self.data, self.at)
        self.at += size
        return number
