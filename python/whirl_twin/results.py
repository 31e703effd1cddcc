"""Results of reports: the values that the command prints with --json, as attributes, tables and figures."""

from __future__ import annotations

import difflib
import html
from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING, Any

from .errors import InputError, RunError

if TYPE_CHECKING:
    import matplotlib.axes
    import matplotlib.figure
    import pandas


def preformatted(text: str) -> str:
    """HTML of a text in columns."""
    return f"<pre>{html.escape(text)}</pre>"


def near(name: str, names: list[str]) -> str:
    """"; did you mean NAME?", or what there is."""
    close = difflib.get_close_matches(name, names, 1)
    return f"; did you mean '{close[0]}'?" if close else f"; there are: {', '.join(names)}" if names else ""


def data_frame(columns: Mapping[str, Any], **options: Any) -> "pandas.DataFrame":
    """A table of pandas. Raises RunError where that is not installed."""
    try:
        import pandas
    except ImportError:
        raise RunError("to_dataframe: needs pandas: install python3-pandas") from None
    return pandas.DataFrame(dict(columns), **options)


def drawn(figure: dict[str, Any], ax: "matplotlib.axes.Axes | None") -> "matplotlib.figure.Figure":
    """The figure of a description. Raises RunError where matplotlib is not installed."""
    from .drawing import MissingLibrary, draw
    try:
        return draw(figure, ax)
    except MissingLibrary as error:
        raise RunError(str(error)) from error


class Section(Mapping):
    """A part of a result: its values are attributes and items, units those of the command's reference (SI)."""

    def __init__(self, data: dict[str, Any]):
        self._data = data

    def __getitem__(self, key: str) -> Any:
        if key in self._data:
            return _wrapped(self._data[key])
        raise KeyError(f"no value '{key}'" + near(str(key), list(self._data)))

    def __getattr__(self, name: str) -> Any:
        if name.startswith("__"):
            raise AttributeError(name)
        if name in self.__dict__.get("_data", {}):
            return _wrapped(self._data[name])
        raise AttributeError(f"no value '{name}'" + near(name, list(self.__dict__.get("_data", {}))))

    def __iter__(self) -> Iterator[str]:
        return iter(self._data)

    def __len__(self) -> int:
        return len(self._data)

    def __dir__(self) -> list[str]:
        return [*super().__dir__(), *self._data]

    def to_dict(self) -> dict[str, Any]:
        """Plain dicts, lists, numbers and text; undefined numbers are None."""
        return self._data

    def __repr__(self) -> str:
        return f"<{type(self).__name__} {', '.join(self._data)}>"


def _wrapped(value: Any) -> Any:
    if isinstance(value, dict):
        return Section(value)
    if isinstance(value, list):
        return [_wrapped(entry) for entry in value]
    return value


class Result(Section):
    """What a command computes: all its values (:meth:`to_dict` equals its --json), its text, tables and figures.

    The values of a system are ``result["NAME"]``; with one system they are attributes of the result, too.
    """

    def __init__(self, document: Any, title: str):
        super().__init__(document.to_dict())
        self._document = document
        self._title = title

    def _systems(self) -> dict[str, Any]:
        systems = self._data.get("systems")
        return systems if isinstance(systems, dict) else {}

    def __getitem__(self, key: str) -> Any:
        if key not in self._data and key in self._systems():
            return _wrapped(self._systems()[key])
        return super().__getitem__(key)

    def __getattr__(self, name: str) -> Any:
        if name.startswith("_"):
            raise AttributeError(name)
        systems = list(self._systems().values())
        if name not in self._data and len(systems) == 1 and name in systems[0]:
            return _wrapped(systems[0][name])
        return super().__getattr__(name)

    @property
    def text(self) -> str:
        """What the command prints."""
        return self._document.text

    @property
    def ok(self) -> bool:
        """False where the command's exit status is 1; ``failure`` has the reason."""
        return self._document.done

    @property
    def failure(self) -> str:
        return self._document.failure

    @property
    def tables(self) -> list[str]:
        """Names of the tables of --csv; the main one is ""."""
        return [name for name, _ in self._document.tables()]

    def table(self, name: str | None = None) -> dict[str, list]:
        """The columns of a table, by default the first one: lists of equal length, None where a cell is empty.

        Raises InputError for a name that is not there.
        """
        tables = self._document.tables()
        for each, columns in tables:
            if name is None or each == name:
                return columns
        raise InputError(f"table: {self._title} has no table '{name}'" + near(str(name), [each for each, _ in tables]))

    def to_dataframe(self, name: str | None = None) -> "pandas.DataFrame":
        """A table of --csv, by default the first one, as a pandas DataFrame; SI units."""
        return data_frame(self.table(name))

    @property
    def figures(self) -> list[str]:
        """Names of the figures: of the systems, controllers or runs that they show."""
        return self._document.figures()

    def plot(self, name: str | None = None, ax: "matplotlib.axes.Axes | None" = None) -> "matplotlib.figure.Figure":
        """Draws the figure of --plot.

        name: which one, of several (:attr:`figures`). ax: axes of matplotlib to draw a single chart into.

        Returns the figure of matplotlib. Raises InputError where there is none or the name is needed, RunError
        without matplotlib.
        """
        figures = self.figures
        if not figures:
            raise InputError(f"plot: {self._title} has no figure here")
        if name is None and len(figures) > 1:
            raise InputError(f"plot: name: missing; must be one of {', '.join(figures)}")
        if name is not None and name not in figures:
            raise InputError(f"plot: no figure '{name}'" + near(str(name), figures))
        index = 0 if name is None else figures.index(name)
        return drawn(self._document.figure(index), ax)

    def __str__(self) -> str:
        return self.text

    def __repr__(self) -> str:
        return f"<{self._title}: {', '.join(self._systems() or self._data)}>"

    def _repr_html_(self) -> str:
        return preformatted(self.text)
