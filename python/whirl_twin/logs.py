"""Recorded logs as arrays: LCM event logs, rosbags and MCAP files."""

from __future__ import annotations

import os
from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING, Any, Callable

from . import _native
from .errors import InputError, RunError
from .quantities import text
from .results import data_frame, near, preformatted

if TYPE_CHECKING:
    import numpy
    import pandas


class Table(Mapping):
    """The messages of a topic: for each field an array with a value for each message.

    ``recorded`` is the time of recording [s]. Fields of nested messages are ``header.stamp``; times are int64 [ns];
    arrays of numbers are [messages, entries], NaN where a message has fewer; text is a list.
    """

    def __init__(self, topic: str, columns: dict[str, Any]):
        self.topic = topic
        self._columns = columns

    def __getitem__(self, name: str) -> "numpy.ndarray":
        if name not in self._columns:
            raise KeyError(f"{self.topic}: no field '{name}'" + near(str(name), list(self._columns)))
        return self._columns[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._columns)

    def __len__(self) -> int:
        return len(self._columns)

    def to_dataframe(self) -> "pandas.DataFrame":
        """A row for each message; entries of arrays are columns ``name[0]``, ``name[1]`` ..."""
        columns: dict[str, Any] = {}
        for name, values in self._columns.items():
            if getattr(values, "ndim", 1) == 2:
                columns.update({f"{name}[{k}]": values[:, k] for k in range(values.shape[1])})
            else:
                columns[name] = values
        return data_frame(columns)

    def __repr__(self) -> str:
        return f"<Table {self.topic}: {len(self['recorded'])} messages, {', '.join(self._columns)}>"


class Log(Mapping):
    """A recording: ``log["rotor/whirl"]`` is the :class:`Table` of the topic /twin/rotor/whirl."""

    def __init__(self, path: str, topics: dict[str, dict[str, Any]], left_out: int, defects: list[tuple[int, str]]):
        self.path = path
        self.left_out = left_out
        """Number of invalid messages and corrupt places, which are left out."""
        self.defects = defects
        """Offset [bytes] and description of the first of them."""
        self._tables = {topic: Table(topic, columns) for topic, columns in topics.items()}

    def __getitem__(self, topic: str) -> Table:
        found = [each for each in self._tables if each == topic or each.endswith("/" + str(topic).lstrip("/"))]
        if topic in self._tables:
            return self._tables[topic]
        if len(found) == 1:
            return self._tables[found[0]]
        what = f"several topics end in '{topic}': {', '.join(found)}" if found else f"no topic '{topic}'"
        raise KeyError(what + ("" if found else near(str(topic), list(self._tables))))

    def __iter__(self) -> Iterator[str]:
        return iter(self._tables)

    def __len__(self) -> int:
        return len(self._tables)

    def to_dataframe(self, topic: str) -> "pandas.DataFrame":
        """The messages of a topic, a row for each."""
        return self[topic].to_dataframe()

    def __repr__(self) -> str:
        return f"<Log {self.path}: {', '.join(self._tables)}>"

    def _repr_html_(self) -> str:
        return preformatted("\n".join([self.path, *(f"  {topic:40} {len(table['recorded']):9}"
                                                    for topic, table in self._tables.items())]))


def read_log(path: "str | os.PathLike[str]", *, prefix: str = "TWIN_",
             progress: Callable[[float], object] | None = None) -> Log:
    """Reads a recording: FILE.lcmlog, FILE.bag or FILE.mcap of ROS messages.

    prefix: of the channels of a twin in an LCM log; its namespace is then the prefix in small letters. Invalid messages
    are left out and counted. Raises InputError for a file that cannot be read, RunError where the package was built
    without LCM.
    """
    if not isinstance(path, (str, os.PathLike)):
        raise TypeError(f"path: must be a path, found {type(path).__name__}")
    file = os.fspath(path)
    text("prefix", prefix)
    if not hasattr(_native, "read_log"):
        raise RunError(f"{file}: cannot be read: built without LCM: run scripts/setup, then build again")
    if file.endswith(".mcap"):
        from .mcap import read_mcap
        return Log(file, *read_mcap(file))
    topics, left_out, defects = _native.read_log(file, prefix, progress)
    if not topics:
        raise InputError(f"{file}: must have messages on channels that begin with {prefix} (prefix), found none")
    return Log(file, topics, left_out, defects)
