"""Studies that need many solves, and transients of a film."""

from __future__ import annotations

import json
import os
from collections.abc import Iterable, Mapping
from typing import Any

import numpy as np

from . import _squeezefilm, _text
from ._progress import Progress, told
from ._scene import Scene
from ._table import Table, rows_html


class Found(dict[str, Any]):
    """An object as ``--json`` prints it. Its keys are also attributes."""

    #: The scene with the values found, of a fit or an optimum.
    scene_found: Scene | None = None

    def __getattr__(self, name: str) -> Any:
        try:
            return self[name]
        except KeyError:
            raise AttributeError(f"there is no {name!r}; there are {', '.join(self)}") from None

    def __dir__(self) -> list[str]:
        return sorted({*super().__dir__(), *self})

    def table(self, name: str = "rows") -> Table:
        """A list of objects as a table: of a fit its measurements, of a start-up its cycles."""
        return Table.of_rows(self[name])

    def __repr__(self) -> str:
        return f"<squeezefilm.Found {self.get('preset')!r}: {', '.join(self)}>"

    def _repr_html_(self) -> str:
        plain = ((name, value) for name, value in self.items() if not isinstance(value, (list, dict)))
        tables = (f"<p>{name}</p>" + Table.of_rows(rows)._repr_html_() for name, rows in self.items() if _is_table(rows))
        return rows_html(("", ""), plain) + "".join(tables)


def _is_table(value: Any) -> bool:
    flat = isinstance(value, list) and value and all(isinstance(row, dict) for row in value)
    return bool(flat) and not any(isinstance(cell, (list, dict)) for row in value for cell in row.values())


def sensitivity(
    scene: Scene,
    keys: Iterable[str] = (),
    uncertainties: Mapping[str, float | str] | None = None,
    *,
    draws: int = 0,
    seed: int = 1,
    accuracy: float | str | None = None,
    fidelity: str | None = None,
    progress: Progress = None,
) -> Found:
    """Derivatives of the results by each key (all keys that are numbers, if none is named), each with its error.

    uncertainties: one standard deviation of each key, ``0.5`` in its unit or ``"20%"``; `draws` random scenes are solved for them (0, or 2
    and more).
    Returns the object of ``squeezefilm sensitivity --json``. Raises `SceneError` or `SolveError`.
    """
    given = [(_text.key(name), str(amount)) for name, amount in (uncertainties or {}).items()]
    asked = [_text.key(name) for name in _text.several(keys)]
    if asked:
        asked += [name for name, _ in given if name not in asked]
    how = _text.how(accuracy, fidelity)
    with told(progress, "sensitivity") as tell:
        return Found(json.loads(_squeezefilm.sensitivity(scene._inner, asked, given, (draws, seed), how, tell)))


#: Bounds of a key: ``(from, to)``, or ``(from, to, "log")`` for a search by equal ratios, ``"lin"`` for one by equal steps.
Bounds = tuple[Any, ...]


def _bounds(vary: Mapping[str, Bounds]) -> list[str]:
    return [f"{_text.key(name)}={':'.join(map(_text.value, ends))}" for name, ends in vary.items()]


def fit(
    scene: Scene,
    data: str | os.PathLike[str] | Mapping[str, Iterable[Any]],
    vary: Mapping[str, Bounds],
    *,
    errors: Iterable[str] = (),
    skip: Iterable[str] = (),
    starts: int = 1,
    accuracy: float | str | None = None,
    fidelity: str | None = None,
    method: str = "auto",
    progress: Progress = None,
) -> Found:
    """Chooses keys of a scene to agree with measurements, by least squares.

    data: ``"table1"``, the path of a CSV file, or its columns (a dict of lists, a `Table`, a pandas or polars frame). Columns are keys of
    the scene, the condition of each row; numbers of a run by their name, or ``rotor_speed_rpm`` with ``torque_nm``, measured; and such a
    name with ``_error`` behind it, its standard error. vary: the bounds of each key, in its unit. errors: standard errors of the
    measurements, ``"1%"``, ``"0.005"`` or ``"film_load_n=1%"``. skip: rows to leave out. starts: how many starts are tried.

    Returns the object of ``squeezefilm fit --json``: ``unknowns`` with values and standard errors, ``covariance``, ``rows``, …;
    ``scene_found`` is the scene with the values found. Raises `SceneError` or `SolveError`.
    """
    if isinstance(data, (str, os.PathLike)):
        source: tuple[str, str | None] = (os.fspath(data), None)
    else:
        columns = {name: list(data[name]) for name in data}
        lengths = {name: len(column) for name, column in columns.items()}
        if len({*lengths.values()}) > 1:
            raise _squeezefilm.SceneError(f"data: columns of different lengths: {lengths}")
        source = ("data", Table.of_rows(dict(zip(columns, row)) for row in zip(*columns.values())).to_csv())
    lists = (_text.several(errors), _text.several(skip))
    how = _text.how(accuracy, fidelity, method)
    with told(progress, "fit", None) as tell:
        text, inner = _squeezefilm.fit(scene._inner, source, _bounds(vary), lists, starts, how, tell)
    return _found(text, inner)


def optimise(
    scene: Scene,
    vary: Mapping[str, Bounds],
    *,
    maximise: str | None = None,
    minimise: str | None = None,
    subject_to: Iterable[str] = (),
    starts: int = 1,
    accuracy: float | str | None = None,
    fidelity: str | None = None,
    progress: Progress = None,
) -> Found:
    """Chooses keys of a scene, each within its bounds, so that a number of the run is as large or as small as it can be.

    maximise, minimise: one of them, the number by its name, as ``"stall_torque_nm"``. subject_to: limits of others, as ``"alpha<0.3"``.

    Returns the object of ``squeezefilm fit --maximise --json``; ``scene_found`` is the scene with the values found. Raises `SceneError`
    or `SolveError`.
    """
    if (maximise is None) == (minimise is None):
        raise _squeezefilm.SceneError("maximise and minimise: give one of them")
    goal = (maximise or minimise or "", maximise is not None)
    how = _text.how(accuracy, fidelity)
    with told(progress, "optimum", None) as tell:
        text, inner = _squeezefilm.optimise(scene._inner, goal, _bounds(vary), _text.several(subject_to), starts, how, tell)
    return _found(text, inner)


def _found(text: str, inner: _squeezefilm.Scene) -> Found:
    found = Found(json.loads(text))
    found.scene_found = Scene._of(inner)
    return found


def startup(
    scene: Scene,
    *,
    cycles: int = 300,
    tolerance: float = 1e-3,
    accuracy: float | str | None = None,
    fidelity: str | None = None,
    progress: Progress = None,
) -> Found:
    """Starts a scene from rest and follows it until the cycle repeats, for at most `cycles` cycles; a plate under a load is dropped.

    tolerance: the change of ln(p h) that may still come when the cycle counts as repeating. Returns the object of ``squeezefilm startup --json``; ``table()`` has a row for each cycle.
    """
    how = _text.how(accuracy, fidelity)
    with told(progress, "start-up") as tell:
        return Found(json.loads(_squeezefilm.startup(scene._inner, cycles, tolerance, how, tell)))


def hold(
    scene: Scene,
    time_s: Iterable[float],
    gap_um: Iterable[float],
    *,
    accuracy: float | str | None = None,
    fidelity: str | None = None,
) -> Table:
    """Force of the film under a plate that is moved through given gaps, at constant speed between two of them. It begins at rest at the first
    gap, with the gas at ambient pressure.

    time_s: ascending instants [s]. gap_um: the gap at each of them [µm], 0.2 to 3 times the scene's mean gap.

    Returns columns of the same length: ``time_s``, ``gap_um``, ``force_n`` with ``force_error_n`` [N; of a strip ``force_n_per_m``],
    positive apart; ``load_ratio``, the force over ambient pressure × area; ``mean_pressure_kpa``, absolute.
    """
    times, gaps = ([float(value) for value in column] for column in (time_s, gap_um))
    columns = _squeezefilm.hold(scene._inner, times, gaps, _text.how(accuracy, fidelity))
    return Table((name, np.array(column)) for name, column in columns)
