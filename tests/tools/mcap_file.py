"""Reads MCAP files as strictly as their specification allows (mcap.dev, version 0): every record where it may be, every
offset, length, count and checksum as it has to be. It shares nothing with the writer."""
import collections
import struct
import zlib

MAGIC = b'\x89MCAP0\r\n'
(HEADER, FOOTER, SCHEMA, CHANNEL, MESSAGE, CHUNK, MESSAGE_INDEX, CHUNK_INDEX, STATISTICS, SUMMARY_OFFSET, DATA_END) = (
    1, 2, 3, 4, 5, 6, 7, 8, 11, 14, 15)


class Content:
    """Takes a record apart."""

    def __init__(self, data):
        self.data, self.at = data, 0

    def number(self, width):
        self.at += width
        assert self.at <= len(self.data)
        return int.from_bytes(self.data[self.at - width:self.at], 'little')

    def bytes(self, width):
        length = self.number(width)
        self.at += length
        assert self.at <= len(self.data)
        return self.data[self.at - length:self.at]

    def text(self):
        return self.bytes(4).decode('utf-8')

    def pairs(self, key, value):
        """A map; key and value read one."""
        inner = Content(self.bytes(4))
        found = []
        while inner.at < len(inner.data):
            found.append((key(inner), value(inner)))
        return found

    def end(self):
        assert self.at == len(self.data), 'bytes left over'


def records(data, begin=0):
    """(offset, opcode, content) one after another; all must be whole."""
    while begin < len(data):
        opcode, length = struct.unpack_from('<BQ', data, begin)
        end = begin + 9 + length
        assert end <= len(data), 'a record beyond the end'
        yield begin, opcode, data[begin + 9:end]
        begin = end


class McapFile:
    """messages: (channel id, sequence, log time, publish time, data) in the order of the file; channels: id -> (topic,
    schema id, metadata); schemas: id -> (name, definition)."""

    def __init__(self, path, unlz4=None):
        with open(path, 'rb') as file:
            self.data = file.read()
        self.unlz4 = unlz4
        self.schemas, self.channels, self.messages, self.chunks = {}, {}, [], {}
        assert self.data[:8] == MAGIC and self.data[-8:] == MAGIC
        self.walk()

    def walk(self):
        inside = self.data[:-8]
        found = list(records(inside, 8))
        assert found[0][1] == HEADER and found[-1][1] == FOOTER
        header = Content(found[0][2])
        self.profile, self.library = header.text(), header.text()
        ends = [i for i, (_, opcode, _) in enumerate(found) if opcode == DATA_END]
        assert len(ends) == 1
        assert found[ends[0]][2] == b'\0' * 4
        self.data_section(found[1:ends[0]])
        self.summary(found[ends[0] + 1:-1], found[-1])

    def data_section(self, found):
        chunk = None
        for offset, opcode, content in found:
            if opcode == CHUNK:
                chunk = self.chunk(offset, content)
            else:
                assert opcode == MESSAGE_INDEX and chunk, 'nothing but chunks and their indexes'
                index = Content(content)
                channel = index.number(2)
                assert channel not in chunk['indexes']
                entries = index.pairs(lambda c: c.number(8), lambda c: c.number(8))
                index.end()
                chunk['indexes'][channel] = (offset, entries)
                chunk['index_length'] += 9 + len(content)
        for chunk in self.chunks.values():
            indexed = sorted((at, channel, time) for channel, (_, entries) in chunk['indexes'].items() for time, at in entries)
            assert indexed == sorted(chunk['placed'])

    def chunk(self, offset, content):
        head = Content(content)
        first, last, size, crc = head.number(8), head.number(8), head.number(8), head.number(4)
        compression = head.text()
        packed = head.bytes(8)
        head.end()
        assert compression in ('', 'lz4')
        inner = self.unlz4(packed) if compression else packed
        assert len(inner) == size and zlib.crc32(inner) == crc
        placed = []
        times = []
        for at, opcode, record in records(inner):
            if opcode == MESSAGE:
                channel, sequence, logged, published = struct.unpack_from('<HIQQ', record)
                assert channel in self.channels
                placed.append((at, channel, logged))
                times.append(logged)
                self.messages.append((channel, sequence, logged, published, record[22:]))
            else:
                self.definition(opcode, record, self.schemas, self.channels)
        assert (first, last) == (min(times), max(times))
        self.chunks[offset] = {'length': 9 + len(content), 'span': (first, last), 'placed': placed, 'indexes': {},
                               'index_length': 0, 'compression': compression, 'sizes': (len(packed), size)}
        return self.chunks[offset]

    def definition(self, opcode, record, schemas, channels):
        content = Content(record)
        if opcode == SCHEMA:
            number, name, encoding, text = content.number(2), content.text(), content.text(), content.text()
            assert number > 0 and number not in schemas and encoding == self.profile + 'msg'
            schemas[number] = (name, text)
        else:
            assert opcode == CHANNEL
            number, schema, topic, encoding = content.number(2), content.number(2), content.text(), content.text()
            metadata = content.pairs(Content.text, Content.text)
            assert number not in channels and schema in schemas
            assert encoding == {'ros1': 'ros1', 'ros2': 'cdr'}[self.profile]
            assert len(dict(metadata)) == len(metadata)
            channels[number] = (topic, schema, dict(metadata))
        content.end()

    def summary(self, found, footer):
        content = Content(footer[2])
        start, offsets, crc = content.number(8), content.number(8), content.number(4)
        content.end()
        assert crc == zlib.crc32(self.data[start:footer[0] + 9 + 16])
        groups, schemas, channels, chunks = [], {}, {}, set()
        for offset, opcode, record in found:
            if opcode != SUMMARY_OFFSET:
                assert offset < offsets
                if not groups or groups[-1][0] != opcode:
                    assert opcode not in [group[0] for group in groups], 'not grouped'
                    groups.append([opcode, offset, 0])
                groups[-1][2] += 9 + len(record)
            if opcode in (SCHEMA, CHANNEL):
                self.definition(opcode, record, schemas, channels)
            elif opcode == CHUNK_INDEX:
                chunks.add(self.chunk_index(record))
            elif opcode == STATISTICS:
                self.statistics(record)
        told = [[c.number(1), c.number(8), c.number(8)] for c in (Content(r) for _, o, r in found if o == SUMMARY_OFFSET)]
        assert told == groups and STATISTICS in [group[0] for group in groups]
        assert found[0][0] == start and (schemas, channels) == (self.schemas, self.channels)
        assert chunks == set(self.chunks)

    def chunk_index(self, record):
        index = Content(record)
        span = (index.number(8), index.number(8))
        offset, length = index.number(8), index.number(8)
        indexes = dict(index.pairs(lambda c: c.number(2), lambda c: c.number(8)))
        index_length, compression, sizes = index.number(8), index.text(), (index.number(8), index.number(8))
        index.end()
        chunk = self.chunks[offset]
        assert (span, length, compression, sizes, index_length) == tuple(
            chunk[key] for key in ('span', 'length', 'compression', 'sizes', 'index_length'))
        assert indexes == {channel: at for channel, (at, _) in chunk['indexes'].items()}
        return offset

    def statistics(self, record):
        told = Content(record)
        assert told.number(8) == len(self.messages)
        assert (told.number(2), told.number(4)) == (len(self.schemas), len(self.channels))
        assert (told.number(4), told.number(4), told.number(4)) == (0, 0, len(self.chunks))
        times = [message[2] for message in self.messages] or [0]
        assert (told.number(8), told.number(8)) == (min(times), max(times))
        counts = dict(told.pairs(lambda c: c.number(2), lambda c: c.number(8)))
        told.end()
        assert counts == collections.Counter(message[0] for message in self.messages)

    def told(self):
        """(topic, type, MD5 sum, time [ns], bytes) in the order of the file."""
        return [(self.channels[c][0], self.schemas[self.channels[c][1]][0], self.channels[c][2]['md5sum'], time, data)
                for c, _, time, _, data in self.messages]


def whole_chunks(data):
    """How many messages a file that was broken off still has: none of its end is needed."""
    count, at = 0, 8
    while at + 9 <= len(data):
        opcode, length = struct.unpack_from('<BQ', data, at)
        if at + 9 + length > len(data):
            break
        if opcode == CHUNK:
            head = Content(data[at + 9:at + 9 + length])
            head.at = 28
            assert head.text() == ''
            count += sum(1 for _, inner, _ in records(head.bytes(8)) if inner == MESSAGE)
        at += 9 + length
    return count
