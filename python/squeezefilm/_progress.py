"""How much is done."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any, Union

#: A function that is told, ``True`` for a bar, ``False`` for none, ``None`` for a bar in a notebook.
Progress = Union[Callable[[float], Any], bool, None]


def in_notebook() -> bool:
    """Whether this runs in a kernel of Jupyter."""
    ipython = sys.modules.get("IPython")
    return ipython is not None and hasattr(ipython.get_ipython(), "kernel")


@contextmanager
def told(progress: Progress, what: str, total: float | None = 1.0) -> Iterator[Callable[[float], Any] | None]:
    """The function that is told how much is done, of `total`, or how many points, if nobody knows of how many."""
    if callable(progress):
        yield progress
        return
    if not (in_notebook() if progress is None else progress):
        yield None
        return
    try:
        from tqdm.auto import tqdm
    except ImportError:
        yield None
        return
    shares = {"bar_format": "{l_bar}{bar}| {elapsed}<{remaining}"} if total else {"unit": " points"}
    with tqdm(total=total, desc=what, **shares) as bar:
        yield lambda done: bar.update(done - bar.n)
