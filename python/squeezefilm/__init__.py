"""The squeezed air film of ultrasonic motors, solved, with an error for every number.

>>> import squeezefilm as sf
>>> run = sf.preset("fundamental").with_(film_min_spacing_nm=100).solve(accuracy=0.001)
>>> run.alpha, run.alpha_error

Keys are those of the command line, with an underscore for the dot: ``film_min_spacing_nm`` is ``film.min_spacing_nm``. Numbers of a
run are those of ``squeezefilm solve --json``, fields those of ``fields.npz``; both have their unit in the name.
"""

from __future__ import annotations

import csv
import html
import io
import json
import os
import warnings
from collections.abc import Callable, Iterable, Mapping
from typing import Any

import numpy as np

from . import _squeezefilm
from ._squeezefilm import SceneError, SolveError, __version__

__all__ = [
    "Run",
    "Scene",
    "SceneError",
    "SolveError",
    "Table",
    "__version__",
    "load",
    "preset",
    "presets",
    "sensitivity",
    "sweep",
]


def presets() -> list[str]:
    """Names of the built-in presets."""
    return _squeezefilm.built_in()


def preset(name: str) -> Scene:
    """The built-in preset of this name. Raises `SceneError`, which names the nearest one."""
    return Scene(_squeezefilm.Scene.preset(name))


def load(path: str | os.PathLike[str]) -> Scene:
    """The scene of a preset file. Raises `SceneError` with the key, its value and what is allowed."""
    return Scene(_squeezefilm.Scene.load(os.fspath(path)))


def _text(value: Any) -> str:
    """A value as `--set` takes it."""
    if isinstance(value, (bool, np.bool_)):
        return "true" if value else "false"
    if value is None:
        return "none"
    return repr(float(value)) if isinstance(value, (float, np.floating)) else str(value)


def _key(name: str) -> str:
    """`film_min_spacing_nm` as `film.min_spacing_nm`; a key with a dot stays as it is."""
    return name if "." in name or "_" not in name else name.replace("_", ".", 1)


class Scene:
    """A motor or a plate that can be solved. It does not change: `with_` makes another."""

    def __init__(self, inner: _squeezefilm.Scene) -> None:
        self._inner = inner

    @classmethod
    def from_toml(cls, text: str) -> Scene:
        """The scene of a preset file's text."""
        return cls(_squeezefilm.Scene.from_toml(text))

    @property
    def name(self) -> str:
        """What it is called."""
        return self._inner.name

    def to_toml(self) -> str:
        """The text of its preset file."""
        return self._inner.to_toml()

    def keys(self) -> dict[str, str]:
        """Its keys, and what each is."""
        return dict(self._inner.keys())

    def with_(self, changes: Mapping[str, Any] | None = None, /, **keys: Any) -> Scene:
        """The same with other values: ``with_(film_min_spacing_nm=100)`` or ``with_({"film.min_spacing_nm": 100})``.

        ``None`` leaves an optional key out. Raises `SceneError`.
        """
        pairs = {**(changes or {}), **keys}
        return Scene(self._inner.changed([(_key(key), _text(value)) for key, value in pairs.items()]))

    def solve(
        self,
        accuracy: float | str | None = None,
        *,
        fidelity: str | None = None,
        method: str = "auto",
        budget_ms: float | None = None,
    ) -> Run:
        """Solves for the periodic steady state, without Python's lock; Ctrl-C ends it.

        accuracy: relative error of the headline, ``0.001`` or ``"0.1%"``; or a `fidelity`, ``"draft"`` to ``"reference"`` (``"standard"``).
        method: ``"auto"``, or ``"paper"`` for the algorithm of Maeno and Bogy. budget_ms: time after which the best so far is returned.

        A run that did not converge is returned with a warning, and ``converged`` false. Raises `SceneError` or `SolveError`.
        """
        asked = None if accuracy is None else str(accuracy)
        return Run(self._inner.solve(asked, fidelity, method, budget_ms))

    def __repr__(self) -> str:
        return f"<squeezefilm.Scene {self.name!r}>"

    def __reduce__(self) -> tuple[Any, ...]:
        return Scene.from_toml, (self.to_toml(),)


#: Numbers that need solves of their own.
_TORQUE = frozenset({"torque"})


class Run:
    """A solved scene. Its attributes are the keys of ``squeezefilm solve --json`` (``alpha``, ``alpha_error``, ``validity``, …)
    and the arrays of ``fields.npz`` (``pressure_kpa`` with axes frame, map_x, map_y; …); ``dir(run)`` lists both."""

    def __init__(self, inner: _squeezefilm.Run) -> None:
        self._inner = inner
        self._summaries: dict[bool, dict[str, Any]] = {}
        self._fields: dict[str, tuple[tuple[str, ...], np.ndarray]] | None = None
        summary = self.summary()
        if not summary["converged"]:
            warnings.warn(f"{summary['preset']}: {summary['status']}", RuntimeWarning, stacklevel=3)

    @property
    def scene(self) -> Scene:
        """What was solved."""
        return Scene(self._inner.scene)

    def summary(self, torque: bool = False) -> dict[str, Any]:
        """The object of ``squeezefilm solve --json``. torque: with torque over speed, which is solved for when it is first asked for."""
        if torque not in self._summaries:
            self._summaries[torque] = json.loads(self._inner.summary(torque))
        return self._summaries[torque]

    def fields(self) -> dict[str, tuple[tuple[str, ...], np.ndarray]]:
        """Of each field the names of its axes, and the array (float64)."""
        if self._fields is None:
            self._fields = self._inner.fields()
        return self._fields

    def __getattr__(self, name: str) -> Any:
        if name.startswith("_"):
            raise AttributeError(name)
        summary = self.summary(name in _TORQUE)
        if name in summary:
            return summary[name]
        fields = self.fields()
        if name in fields:
            return fields[name][1]
        raise AttributeError(f"a run has no {name!r}; dir(run) lists what it has")

    def __dir__(self) -> list[str]:
        return sorted({*super().__dir__(), *self.summary(), *_TORQUE, *self.fields()})

    def to_xarray(self) -> Any:
        """The fields as an ``xarray.Dataset`` with coordinates and units (needs xarray)."""
        import xarray

        fields = self.fields()
        coordinates = {"frame": "time_s", "node": "x_m", "tooth": "tooth_middle_m", "map_x": "map_x_m", "map_y": "map_y_m"}
        unit = {name: name.rsplit("_", 1)[-1] for name in fields if name != "teeth_in_contact"}
        variables = {
            name: (axes, array, {"units": unit[name]} if name in unit else {})
            for name, (axes, array) in fields.items()
            if name not in coordinates.values() and array.size
        }
        coords = {name: (fields[name][0], fields[name][1]) for name in coordinates.values() if name in fields}
        return xarray.Dataset(variables, coords, {key: self.summary()[key] for key in ("preset", "version")})

    def plot_wave(self, phase: float = 0.0, ax: Any = None) -> Any:
        """Draws teeth and rotor over one wavelength at a phase 0 … 1 of the cycle (needs matplotlib; motors only); returns the axes."""
        if ax is None:
            import matplotlib.pyplot as plt

            ax = plt.subplots(figsize=(8, 3))[1]
        for i, (x, stator, rotor) in enumerate(self._wave(phase)):
            ax.plot(1e3 * x, stator, color="C1", label=None if i else "teeth of the stator")
            ax.plot(1e3 * x, rotor, color="C0", label=None if i else "rotor")
        ax.set(xlabel="along the wave (mm)", ylabel="height (nm)", title=f"{self.preset}, t/T = {phase % 1:.2f}")
        ax.legend(loc="upper right")
        return ax

    def _wave(self, phase: float) -> list[tuple[np.ndarray, np.ndarray, np.ndarray]]:
        """Of each tooth x [m], the height of its top and of the rotor above it [nm] at a phase of the cycle."""
        fields = self.fields()
        if "stator_nm" not in fields:
            raise AttributeError("a plate has no wave")
        stator, gap = fields["stator_nm"][1], fields["gap_nm"][1]
        frame = round(phase * len(stator)) % len(stator)
        middles, x = fields["tooth_middle_m"][1], fields["x_m"][1]
        return [(middle + x, stator[frame, k], stator[frame, k] + gap[frame, k]) for k, middle in enumerate(middles)]

    def __repr__(self) -> str:
        return f"<squeezefilm.Run {self.preset!r}: {self._headline()}>"

    def _headline(self) -> str:
        name, error = ("alpha", "alpha_error") if self.alpha is not None else ("mean_load_ratio", "mean_load_ratio_error")
        return f"{name} = {getattr(self, name):.6g} ± {getattr(self, error):.1g}"

    def _repr_html_(self) -> str:
        shown = {
            "share of the load on the film α": ("alpha", "alpha_error", ""),
            "load over ambient pressure × area": ("mean_load_ratio", "mean_load_ratio_error", ""),
            "film load": ("film_load_n", "film_load_error_n", self.force_unit),
            "stall torque": ("stall_torque_nm", "stall_torque_error_nm", "N m"),
            "highest pressure": ("max_pressure_kpa", "max_pressure_error_kpa", "kPa"),
        }
        rows = ""
        for words, (name, error, unit) in shown.items():
            value, spread = self.summary().get(name), self.summary().get(error)
            if value is not None:
                plus = "" if spread is None else f" ± {spread:.1g}"
                rows += f"<tr><th style='text-align:left'>{words}</th><td>{value:.5g}{plus} {unit}</td></tr>"
        return f"<b>{html.escape(self.preset)}</b><table>{rows}</table>{self._svg()}"

    def _svg(self) -> str:
        """The wave at the start of the cycle as a small picture."""
        if "stator_nm" not in self.fields():
            return ""
        teeth = self._wave(0.0)
        heights = np.concatenate([np.concatenate(lines[1:]) for lines in teeth])
        (low, high), (left, right) = (heights.min(), heights.max()), (teeth[0][0][0], teeth[-1][0][-1])

        def line(x: np.ndarray, y: np.ndarray, colour: str) -> str:
            points = zip(400 * (x - left) / (right - left), 75 - 70 * (y - low) / max(high - low, 1e-9))
            path = " ".join(f"{a:.1f},{b:.1f}" for a, b in points)
            return f"<polyline points='{path}' fill='none' stroke='{colour}' stroke-width='2'/>"

        drawn = "".join(line(x, stator, "#e69f00") + line(x, rotor, "#4a90c2") for x, stator, rotor in teeth)
        return f"<svg width='400' height='80' role='img' aria-label='teeth and rotor'>{drawn}</svg>"


class Table(dict):
    """Columns of a sweep by name, NumPy arrays of one length; ``pandas.DataFrame(table)`` and ``polars.DataFrame(table)`` take it."""

    @classmethod
    def of_csv(cls, text: str) -> Table:
        """The table of a CSV text: numbers where a whole column is numbers or empty, else text."""
        head, *rows = csv.reader(io.StringIO(text))
        return cls((name, _column([row[i] for row in rows])) for i, name in enumerate(head))

    @property
    def rows(self) -> int:
        """How many rows there are."""
        return len(next(iter(self.values()), ()))

    def __repr__(self) -> str:
        return f"<squeezefilm.Table {self.rows} rows: {', '.join(self)}>"


def _column(values: list[str]) -> np.ndarray:
    try:
        return np.array([float(value) if value else np.nan for value in values])
    except ValueError:
        return np.array(values)


#: Points that one task of a `client` solves: from the points alone, so that any number of machines gives the same bytes.
CHUNK = 64


def sweep(
    scene: Scene,
    key: str | Mapping[str, Iterable[float]],
    values: Iterable[float] | None = None,
    *,
    accuracy: float | str | None = None,
    fidelity: str | None = None,
    progress: Callable[[float], Any] | None = None,
    client: Any = None,
) -> Table:
    """Solves a scene at every value of a key, or every pair of two: ``sweep(scene, "film.min_spacing_nm", [100, 200])`` or
    ``sweep(scene, {"film.min_spacing_nm": [...], "stator.frequency_khz": [...]})``.

    On all cores, without Python's lock. progress: called with the share that is done. client: a Dask client or a
    `concurrent.futures` executor; chunks of the first key's values are then solved by its workers, and a lost worker costs its chunk alone.
    Returns the columns of ``squeezefilm sweep``'s CSV. Raises `SceneError` or `SolveError`.
    """
    given = key if isinstance(key, Mapping) else {key: () if values is None else values}
    axes = [(_key(name), [float(value) for value in points]) for name, points in given.items()]
    asked = None if accuracy is None else str(accuracy)
    if client is None:
        text = [(name, ",".join(map(repr, points))) for name, points in axes]
        return Table.of_csv(_squeezefilm.sweep(scene._inner, text, asked, fidelity, progress))
    (name, points), *others = axes
    size = max(1, CHUNK // max(1, int(np.prod([len(other) for _, other in others]))))
    chunks = [points[i : i + size] for i in range(0, len(points), size)]
    tasks = [client.submit(_chunk, scene, [(name, chunk), *others], asked, fidelity) for chunk in chunks]
    parts = []
    for i, task in enumerate(tasks):
        parts.append(Table.of_csv(task.result()))
        if progress is not None:
            progress((i + 1) / len(tasks))
    return Table((column, np.concatenate([part[column] for part in parts])) for column in parts[0])


def _chunk(scene: Scene, axes: list[tuple[str, list[float]]], accuracy: str | None, fidelity: str | None) -> str:
    return _squeezefilm.sweep(scene._inner, [(name, ",".join(map(repr, points))) for name, points in axes], accuracy, fidelity, None)


def sensitivity(
    scene: Scene,
    keys: Iterable[str] = (),
    uncertainties: Mapping[str, float | str] | None = None,
    *,
    draws: int = 0,
    seed: int = 1,
    accuracy: float | str | None = None,
    fidelity: str | None = None,
) -> dict[str, Any]:
    """Derivatives of the results by each key (all keys that are numbers, if none is named), each with its error.

    uncertainties: one standard deviation of each key, ``0.5`` in its unit or ``"20%"``; `draws` random scenes are solved for them.
    Returns the object of ``squeezefilm sensitivity --json``.
    """
    given = [(_key(name), str(amount)) for name, amount in (uncertainties or {}).items()]
    asked = None if accuracy is None else str(accuracy)
    found = _squeezefilm.sensitivity(scene._inner, [_key(key) for key in keys], given, draws, seed, asked, fidelity)
    return json.loads(found)
