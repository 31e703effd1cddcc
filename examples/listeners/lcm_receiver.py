"""Receives what is sent over LCM's UDP multicast, with Python's own library alone: Debian has no LCM for Python 3.

    for channel, data in LcmReceiver():
        if channel == 'TWIN_ROTOR_WHIRL':
            state = whirl_state_t.decode(data)

A message is one datagram, or so many fragments (github.com/lcm-proj/lcm, docs/content/udp-multicast-protocol.md). Of one
that lost a fragment nothing is given.
"""
import collections
import os
import socket
import struct
import urllib.parse

WHOLE, FRAGMENT = b'LC02', b'LC03'
FRAGMENT_HEADER = struct.Struct('>4sIIIHH')  # magic, message, its bytes, where this part begins, which, of how many
MOST_INCOMPLETE = 64  # messages of which parts are awaited


class LcmReceiver:
    """Iterates over (channel, data) of what arrives; waits for the next one. url: as LCM writes it."""

    def __init__(self, url=None):
        parts = urllib.parse.urlsplit(url or os.environ.get('LCM_DEFAULT_URL') or 'udpm://239.255.76.67:7667')
        if parts.scheme != 'udpm' or not parts.hostname or not parts.port:
            raise ValueError('an LCM URL is expected, udpm://239.255.76.67:7667 say, found %r' % url)
        self.incomplete = collections.OrderedDict()
        self.socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self.socket.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        self.socket.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 1 << 22)
        self.socket.bind((parts.hostname, parts.port))
        group = socket.inet_aton(parts.hostname) + socket.inet_aton('0.0.0.0')
        self.socket.setsockopt(socket.IPPROTO_IP, socket.IP_ADD_MEMBERSHIP, group)

    def __iter__(self):
        while True:
            message = self.take(*self.socket.recvfrom(1 << 16))
            if message:
                yield message

    def take(self, datagram, sender):
        """The message that this datagram completes, as (channel, data), or None."""
        if datagram[:4] == WHOLE:
            return split(datagram[8:])
        if datagram[:4] != FRAGMENT or len(datagram) < FRAGMENT_HEADER.size:
            return None
        _, message, _, _, number, count = FRAGMENT_HEADER.unpack_from(datagram)
        parts = self.incomplete.setdefault((sender, message), {})
        parts[number] = datagram[FRAGMENT_HEADER.size:]
        if len(parts) == count:
            del self.incomplete[sender, message]
            return split(b''.join(parts[i] for i in sorted(parts)))
        if len(self.incomplete) > MOST_INCOMPLETE:
            self.incomplete.popitem(last=False)
        return None


def split(content):
    """Channel and data of a message."""
    channel, _, data = content.partition(b'\0')
    return channel.decode(errors='replace'), data
