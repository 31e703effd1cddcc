"""MCAP files of ROS 1 messages (format version 0, profile "ros1")."""

from __future__ import annotations

import struct
from typing import Any, Iterator

from . import _native
from .errors import InputError

_MAGIC = b"\x89MCAP0\r\n"
_HEAD = struct.Struct("<BQ")
_SCHEMA, _CHANNEL, _MESSAGE, _CHUNK = 3, 4, 5, 6


class _Corrupt(Exception):
    """A record that cannot be read."""


def _records(data: memoryview, at: int = 0) -> Iterator[tuple[int, int, memoryview]]:
    """(offset, opcode, content) of each; a record that is cut off ends them."""
    while at + _HEAD.size <= len(data):
        opcode, size = _HEAD.unpack_from(data, at)
        begin = at + _HEAD.size
        if size > len(data) - begin:
            return
        yield at, opcode, data[begin:begin + size]
        at = begin + size


def _text(content: memoryview, at: int) -> tuple[str, int]:
    (size,) = struct.unpack_from("<I", content, at)
    if size > len(content) - at - 4:
        raise _Corrupt("text that is cut off")
    return bytes(content[at + 4:at + 4 + size]).decode("utf-8", "replace"), at + 4 + size


def _chunk(content: memoryview, path: str) -> memoryview:
    """The records of a chunk."""
    (expected,) = struct.unpack_from("<Q", content, 16)
    compression, at = _text(content, 28)
    packed = content[at + 8:]
    if compression == "":
        return packed
    if compression == "lz4":
        try:
            import lz4.frame
        except ImportError:
            raise InputError(f"{path}: is compressed by lz4: install python3-lz4") from None
        try:
            unpacked = lz4.frame.decompress(packed)
        except RuntimeError as error:
            raise _Corrupt(f"a chunk: {error}") from None
        if len(unpacked) != expected:
            raise _Corrupt(f"a chunk: must have {expected} bytes, found {len(unpacked)}")
        return memoryview(unpacked)
    raise InputError(f"{path}: must be compressed by lz4 or not at all, found '{compression}'")


def read_mcap(path: str) -> tuple[dict[str, dict[str, Any]], int, list[tuple[int, str]]]:
    """Columns by topic, the number of messages and places left out, and the first of these."""
    try:
        with open(path, "rb") as file:
            data = memoryview(file.read())
    except OSError as error:
        raise InputError(f"{path}: cannot be read: {error.strerror}") from None
    if bytes(data[:len(_MAGIC)]) != _MAGIC:
        raise InputError(f"{path}: must be an MCAP file of version 0, found another header")
    tables = _native.TopicTables()
    schemas: dict[int, tuple[str, str]] = {}  # encoding, definition
    channels: dict[int, tuple[int, str, str]] = {}  # schema, topic, encoding
    defects: list[tuple[int, str]] = []

    def take(opcode: int, content: memoryview, offset: int) -> None:
        if opcode == _SCHEMA:
            (number,) = struct.unpack_from("<H", content, 0)
            _, at = _text(content, 2)
            encoding, at = _text(content, at)
            schemas[number] = (encoding, _text(content, at)[0])
        elif opcode == _CHANNEL:
            number, schema = struct.unpack_from("<HH", content, 0)
            topic, at = _text(content, 4)
            channels[number] = (schema, topic, _text(content, at)[0])
        elif opcode == _MESSAGE:
            number, _, time = struct.unpack_from("<HIQ", content, 0)
            schema, topic, encoding = channels.get(number, (0, "", ""))
            schema_encoding, definition = schemas.get(schema, ("", ""))
            if (encoding, schema_encoding) != ("ros1", "ros1msg"):
                raise _Corrupt(f"{topic or 'a message'}: must be a message of ROS 1")
            if time >= 2**63 or not tables.add(topic, definition, time, bytes(content[22:])):
                raise _Corrupt(f"{topic}: a message that does not match its definition")

    def take_all(records: Iterator[tuple[int, int, memoryview]], base: int | None) -> None:
        for offset, opcode, content in records:
            place = offset if base is None else base
            try:
                if opcode == _CHUNK and base is None:
                    take_all(_records(_chunk(content, path)), offset)
                else:
                    take(opcode, content, place)
            except (_Corrupt, struct.error) as error:
                defects.append((place, str(error)))

    take_all(_records(data, len(_MAGIC)), None)
    return tables.columns(), len(defects), defects[:20]
