"""LCM event logs, written and read as their format says, without the package's reader and writer."""
import struct

SYNC = b'\xed\xa1\xda\x01'


def event(number, stamp, channel, data):
    return SYNC + struct.pack('>qqii', number, stamp, len(channel), len(data)) + channel + data


def events(data):
    """(offset, stamp, channel, payload) of a log without damage."""
    at, found = 0, []
    while at < len(data):
        sync, _, stamp, name, size = struct.unpack_from('>IqqII', data, at)
        assert sync == 0xEDA1DA01
        found.append((at, stamp, data[at + 28:at + 28 + name], data[at + 28 + name:at + 28 + name + size]))
        at += 28 + name + size
    return found
