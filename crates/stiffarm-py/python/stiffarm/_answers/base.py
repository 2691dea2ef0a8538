"""What all answers can do: attributes by the keys of the program's JSON, and the ways out to other libraries."""

from __future__ import annotations

import copy
from typing import TYPE_CHECKING, Any, Generic, TypeVar

import numpy as np

if TYPE_CHECKING:
    import pandas
    import polars

#: The keys of an answer.
D = TypeVar("D")


def _plain(value: Any) -> Any:
    """Arrays as nested lists, and nan as None: what JSON says."""
    if isinstance(value, np.ndarray):
        plain = value.astype(object)
        plain[np.isnan(value)] = None
        return plain.tolist()
    return copy.deepcopy(value)


def _same(one: Any, other: Any) -> bool:
    if isinstance(one, np.ndarray) or isinstance(other, np.ndarray):
        return type(one) is type(other) and np.array_equal(one, other, equal_nan=True)
    return bool(one == other)


class Answer(Generic[D]):
    """An answer; its attributes are the keys of the program's JSON. Absent keys are None."""

    _arrays: tuple[str, ...] = ()
    _data: dict[str, Any]

    def __init__(self, data: dict[str, Any]) -> None:
        arrays = {key: np.asarray(data[key], dtype=np.float64) for key in self._arrays if data.get(key) is not None}
        self._data = {**data, **arrays}

    if not TYPE_CHECKING:  # which knows the keys, and takes no others

        def __getattr__(self, key: str) -> Any:
            if key.startswith("_"):
                raise AttributeError(key)
            if key in self._data:
                return self._data[key]
            if any(key in kind.__dict__.get("__annotations__", ()) for kind in type(self).__mro__):
                return None
            raise AttributeError(f"{type(self).__name__} has no attribute {key!r}; it has {', '.join(self._data)}")

    def __dir__(self) -> list[str]:
        return [*super().__dir__(), *self._data]

    def to_dict(self) -> D:
        """The JSON of the program, as `json.loads` reads it."""
        plain: Any = {key: _plain(value) for key, value in self._data.items()}
        fields: D = plain
        return fields

    def __eq__(self, other: object) -> bool:
        if type(self) is not type(other) or not isinstance(other, Answer):
            return NotImplemented
        mine, theirs = self._data, other._data
        return mine.keys() == theirs.keys() and all(_same(mine[key], theirs[key]) for key in mine)

    __hash__ = None  # type: ignore[assignment]

    def _words(self) -> str:
        return ", ".join(f"{key}={value!r}" for key, value in self._data.items())

    def __repr__(self) -> str:
        return f"<stiffarm.{type(self).__name__} {self._words()}>"


class Table(Answer[D]):
    """An answer that has rows; its columns are those of the program's CSV, typed whatever they hold."""

    _rows: dict[str, Any]

    def __init__(self, data: dict[str, Any], columns: dict[str, Any] | None = None) -> None:
        super().__init__(data)
        self._rows = {} if columns is None else columns

    def _columns(self) -> dict[str, Any]:
        return self._rows

    def to_pandas(self) -> pandas.DataFrame:
        """The rows as a pandas DataFrame; needs pandas."""
        try:
            import pandas
        except ImportError as error:
            raise ImportError("to_pandas() needs pandas: pip install pandas") from error
        return pandas.DataFrame(self._columns())

    def to_polars(self) -> polars.DataFrame:
        """The rows as a polars DataFrame; needs polars."""
        try:
            import polars
        except ImportError as error:
            raise ImportError("to_polars() needs polars: pip install polars") from error
        return polars.DataFrame(self._columns(), nan_to_null=True, strict=False)
