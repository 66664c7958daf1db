"""Progress as a callback, or as a bar of tqdm's."""

from __future__ import annotations

from contextlib import contextmanager
from typing import Any, Callable, Iterator, Union

Progress = Union[None, bool, Callable[[str, float], Any]]


@contextmanager
def reporter(progress: Progress) -> Iterator[Callable[[str, float], Any] | None]:
    """The callback for the engine: called with a stage's name and the share done, 0 to 1.

    True shows a bar if tqdm is installed. A callback that returns False cancels the run.
    """
    if progress is None or progress is False:
        yield None
    elif callable(progress):
        yield progress
    else:
        with _bar() as bar:
            yield bar


@contextmanager
def _bar() -> Iterator[Callable[[str, float], Any] | None]:
    try:
        from tqdm.auto import tqdm
    except ImportError:
        yield None
        return
    with tqdm(total=100, unit="%", leave=False) as bar:

        def show(stage: str, fraction: float) -> None:
            bar.set_description(stage, refresh=False)
            bar.n = round(100 * fraction)
            bar.refresh()

        yield show
