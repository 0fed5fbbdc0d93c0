"""Sweeps, on this machine or on many."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any

import numpy as np

from . import _squeezefilm, _text
from ._progress import Progress, told
from ._scene import Scene
from ._table import Table

#: Points that one task of a `client` solves, at least, and tasks of a sweep, at most: each pays for being sent.
CHUNK, MOST_TASKS = 64, 256


def sweep(
    scene: Scene,
    key: str | Mapping[str, Iterable[Any]],
    values: Iterable[Any] | None = None,
    *,
    accuracy: float | str | None = None,
    fidelity: str | None = None,
    method: str = "auto",
    progress: Progress = None,
    client: Any = None,
) -> Table:
    """Solves a scene at every value of a key, or every combination of two or three: ``sweep(scene, "film.min_spacing_nm", [100, 200])`` or
    ``sweep(scene, {"film.min_spacing_nm": [...], "stator.frequency_khz": [...]})``.

    values: at least two, each once; numbers in the unit of the key, or words (``"film.slip", ["none", "first-order"]``); or as the command
    line has them, ``"50:400:8:log"``.
    client: a Dask client or an executor of `concurrent.futures`, whose workers solve the points. Parts follow from the points alone, so
    that the table is the same to the last bit with any number of workers, and a worker that is lost costs its part only.

    Returns the columns of ``squeezefilm sweep``'s CSV, a row for each point; the last key varies fastest. A point that failed says so in
    ``status``, and its numbers are NaN. A sweep has at most 100 000 points; of more, ``squeezefilm sweep --part`` solves a part at a time.
    Raises `SceneError` or `SolveError`.
    """
    given = key if isinstance(key, Mapping) else {key: () if values is None else values}
    axes = [(_text.key(name), points if isinstance(points, str) else ",".join(map(_number, points))) for name, points in given.items()]
    how = _text.how(accuracy, fidelity, method)
    with told(progress, "sweep") as tell:
        if client is None:
            return Table.of_csv(_squeezefilm.sweep(scene._inner, axes, how, tell))
        count = min(-(-_squeezefilm.points(scene._inner, axes, how) // CHUNK), MOST_TASKS)
        tasks = [client.submit(_part, scene, axes, how, f"{number}/{count}") for number in range(1, count + 1)]
        parts = []
        for number, task in enumerate(tasks, 1):
            parts.append((f"part {number}", task.result()))
            if tell is not None:
                tell(number / count)
    return Table.of_csv(_squeezefilm.join(parts))


def _number(value: Any) -> str:
    """A value of a sweep: numbers as floating point, as the command line spaces them."""
    plain = isinstance(value, (str, bool, np.bool_)) or value is None
    return _text.value(value if plain else float(value))


def _part(scene: Scene, axes: list[tuple[str, str]], how: _squeezefilm.How, part: str) -> str:
    return _squeezefilm.part(scene._inner, axes, how, part)
