"""Options with the command line's names, ranges and messages."""

from __future__ import annotations

import json
from typing import Any, Mapping

from . import _core
from .errors import UsageError


class Options:
    """The options of a run: keyword arguments with the command line's names, ``-`` written as ``_``.

    ``Options(smallest=0.004, coarsen=False)``. Switches take True or False; ``lambda_`` stands for
    ``--lambda``. Raises UsageError, with the nearest name or the range, for what does not exist or fit.
    """

    def __init__(self, **keywords: Any) -> None:
        self._given = {name.rstrip("_"): value for name, value in keywords.items()}
        self._core = _core.Options([_word(name, value) for name, value in self._given.items()])

    @classmethod
    def for_(cls, kind: str, **keywords: Any) -> Options:
        """Options for a kind of model: "general", "vessels", "neurons", "plants", "cad" or "characters".

        What each sets is in docs/presets.md. Keywords that are given come before it.
        """
        return cls(**{"for": kind, **keywords})

    @property
    def given(self) -> dict[str, Any]:
        """What was set, by name."""
        return dict(self._given)

    @property
    def values(self) -> dict[str, Any]:
        """The values of all options, by the command line's names."""
        return json.loads(self._core.json())

    def replace(self, **keywords: Any) -> Options:
        """The same with other values for some."""
        return Options(**{**self._given, **{name.rstrip("_"): value for name, value in keywords.items()}})

    def __repr__(self) -> str:
        return f"Options({', '.join(f'{name}={value!r}' for name, value in self._given.items())})"

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Options) and self.values == other.values

    __hash__ = None  # type: ignore[assignment]

    def __reduce__(self) -> tuple:
        return (_from_given, (self._given,))


def _from_given(given: dict[str, Any]) -> Options:
    return Options(**given)


def _word(name: str, value: Any) -> str:
    name = name.replace("_", "-")
    if name in ("help", "version") or not name.replace("-", "").isalnum():
        raise UsageError(f"unknown option --{name}")
    if name == "repair" and isinstance(value, bool):
        return f"--repair={'auto' if value else 'off'}"
    if isinstance(value, bool):
        return f"--{name}={'true' if value else 'false'}"
    return f"--{name}={value}"


def describe(mode: str = "default") -> list[dict[str, str]]:
    """A row for each option: name, group, value, default, help."""
    keys = ("name", "group", "value", "default", "help")
    return [dict(zip(keys, row)) for row in _core.option_table(mode)]


def merged(options: Options | None, keywords: Mapping[str, Any]) -> Options:
    """What a function that takes both was given."""
    if options is None:
        return Options(**keywords)
    return options.replace(**keywords) if keywords else options
