"""Solved scenes."""

from __future__ import annotations

import json
import os
import warnings
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from . import _squeezefilm, _text
from ._table import Table, rows_html

if TYPE_CHECKING:
    from ._scene import Scene

Array = npt.NDArray[np.float64]

#: Keys of the summary that need a solve of their own.
_TORQUE = frozenset({"merit"})
#: Numbers that a notebook shows, with their error and their unit.
_HEADLINES = {
    "share of the load on the film α": ("alpha", "alpha_error", ""),
    "mean gap at which it floats": ("mean_gap_um", "mean_gap_error_um", "µm"),
    "load over ambient pressure × area": ("mean_load_ratio", "mean_load_ratio_error", ""),
    "film load": ("film_load_n", "film_load_error_n", "force_unit"),
    "stall torque": ("stall_torque_nm", "stall_torque_error_nm", "N m"),
    "highest pressure": ("max_pressure_kpa", "max_pressure_error_kpa", "kPa"),
}


class Figure:
    """A figure as a file: `data` in `format` ``"svg"``, ``"png"`` or ``"pdf"``. A notebook shows it."""

    def __init__(self, name: str, format: str, data: bytes) -> None:
        self.name, self.format, self.data = name, format, data

    def __repr__(self) -> str:
        return f"<squeezefilm.Figure {self.name}.{self.format}, {len(self.data)} bytes>"

    def _repr_svg_(self) -> str | None:
        return self.data.decode() if self.format == "svg" else None

    def _repr_png_(self) -> bytes | None:
        return self.data if self.format == "png" else None


class Run:
    """A solved scene.

    Its attributes are the keys of ``squeezefilm solve --json``: ``alpha`` and ``alpha_error``, ``film_load_n`` [N on one wavelength or the
    plate; of a strip N/m, see ``force_unit``], ``stall_torque_nm`` [N m], ``max_pressure_kpa`` [kPa, absolute], ``validity``, …; ``merit``
    (torque, power and efficiency over the rotor's speed) is solved for when it is first asked for. Null is ``None``.

    Arrays of one cycle, float64, are attributes too, as in ``fields.npz``:

    ==================== ==================== ==============================================================================
    array                axes                 what
    ==================== ==================== ==============================================================================
    time_s               frame                the instants of one cycle
    x_m, node_length_m   node                 along a tooth or the plate from its middle, and the length each node stands for
                                              (of a round plate radius_m, node_area_m2)
    tooth_middle_m       tooth                where the teeth are (motor)
    stator_nm, gap_nm    frame, tooth, node   tops of the teeth, and the gap between them and the rotor (motor)
    contact_n_per_m      frame, tooth, node   contact force (motor)
    film_thickness_nm    frame, tooth, node   film thickness, minimum spacing included; of a plate frame, node
    film_n_per_m         frame, tooth, node   film force; of a plate frame, node; of a strip or a round plate film_n_per_m2
    map_x_m, map_y_m     map_x, map_y         where the pressure is
    pressure_kpa         frame, map_x, map_y  absolute pressure under the first tooth or the plate
    ==================== ==================== ==============================================================================

    Series over the cycle have the name of their mean, ``fields()["film_load_n"]``. ``dir(run)`` lists all.
    """

    if TYPE_CHECKING:
        preset: str
        status: str
        force_unit: str
        accuracy_asked: float | None
        accuracy_stated: float | None
        stopped_by: str
        alpha: float | None
        alpha_error: float | None
        film_load_n: float | None
        film_load_error_n: float | None
        film_load_min_n: float | None
        film_load_max_n: float | None
        film_load_min_error_n: float | None
        film_load_max_error_n: float | None
        contact_load_n: float | None
        contact_load_error_n: float | None
        stall_torque_nm: float | None
        stall_torque_error_nm: float | None
        max_torque_nm: float | None
        max_torque_error_nm: float | None
        dry_torque_nm: float | None
        teeth_in_contact: float | None
        teeth_in_contact_error: float | None
        levitated: bool | None
        min_gap_nm: float | None
        min_gap_error_nm: float | None
        max_pressure_kpa: float | None
        max_pressure_error_kpa: float | None
        floating: dict[str, Any] | None
        mean_load_ratio: float | None
        mean_load_ratio_error: float | None
        load_ratio_min: float | None
        load_ratio_max: float | None
        load_ratio_min_error: float | None
        load_ratio_max_error: float | None
        squeeze_number: float | None
        bearing_number: float | None
        knudsen_number: float | None
        merit: dict[str, Any] | None
        exact: dict[str, Any] | None
        stats: dict[str, Any]
        model: dict[str, Any]
        validity: list[dict[str, Any]]
        warnings: list[str]
        time_s: Array
        x_m: Array
        node_length_m: Array
        tooth_middle_m: Array
        stator_nm: Array
        gap_nm: Array
        contact_n_per_m: Array
        film_thickness_nm: Array
        film_n_per_m: Array
        map_x_m: Array
        map_y_m: Array
        pressure_kpa: Array

    def __init__(self, inner: _squeezefilm.Run, scene: type[Scene]) -> None:
        self._inner, self._scene = inner, scene
        self._summaries: dict[bool, dict[str, Any]] = {}
        self._fields: dict[str, tuple[tuple[str, ...], Array]] | None = None
        if not inner.converged:
            summary = self.summary()
            warnings.warn(f"{summary['preset']}: {summary['status']}", RuntimeWarning, stacklevel=3)

    @property
    def scene(self) -> Scene:
        """What was solved."""
        return self._scene._of(self._inner.scene)

    @property
    def converged(self) -> bool:
        """Whether the cycle repeats to the tolerance."""
        return self._inner.converged

    @property
    def plot(self) -> Plot:
        """Drawings in Matplotlib: ``run.plot.wave(phase=0.3)``."""
        return Plot(self)

    def summary(self, torque: bool = False) -> dict[str, Any]:
        """The object of ``squeezefilm solve --json``. torque: with ``merit``, which is solved for when it is first asked for."""
        if torque not in self._summaries:
            self._summaries[torque] = json.loads(self._inner.summary(torque))
        return self._summaries[torque]

    def fields(self) -> dict[str, tuple[tuple[str, ...], Array]]:
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
        return sorted({*super().__dir__(), *self.summary(), *self.fields()})

    def torque(self) -> Table:
        """Torque, power and efficiency over the speed of the rotor, with the film and without: the columns of ``torque.csv`` (motors only)."""
        text = self._inner.torque_csv()
        if text is None:
            raise AttributeError("a plate has no torque")
        return Table.of_csv(text)

    def to_xarray(self) -> Any:
        """The fields as an ``xarray.Dataset`` with coordinates and units (needs xarray)."""
        import xarray

        fields = self.fields()
        positions = ("x_m", "radius_m")
        along = {"frame": "time_s", "tooth": "tooth_middle_m", "map_x": "map_x_m", "map_y": "map_y_m"}
        coordinates = {name: fields[name] for name in (*along.values(), *positions) if name in fields}

        def units(name: str) -> dict[str, str]:
            if name == "teeth_in_contact":
                return {}
            stem, _, bottom = name.partition("_per_")
            top = stem.rsplit("_", 1)[-1]
            return {"units": {"n": "N", "kpa": "kPa"}.get(top, top) + (f"/{bottom}" if bottom else "")}

        variables = {
            name: (axes, array, units(name))
            for name, (axes, array) in fields.items()
            if name not in coordinates and array.size
        }
        located = {name: (axes, array, units(name)) for name, (axes, array) in coordinates.items()}
        return xarray.Dataset(variables, located, {key: self.summary()[key] for key in ("preset", "version")})

    def figures(self) -> list[str]:
        """Names of the figures of this run."""
        return self._inner.figures()

    def figure(self, name: str | os.PathLike[str], format: str | None = None) -> Figure:
        """A figure of the library: ``figure("wave")``, or ``figure("results/wave.pdf")``, which is also written.

        The name is one of `figures`; format ``"svg"``, ``"png"`` or ``"pdf"``. Raises `SceneError` for one that is not there.
        """
        path = Path(name)
        chosen = format or path.suffix[1:] or "svg"
        figure = Figure(path.stem, chosen, self._inner.figure(path.stem, chosen))
        if path.suffix:
            path.write_bytes(figure.data)
        return figure

    def save(self, folder: str | os.PathLike[str], figures: Iterable[str] = ("svg", "png")) -> list[str]:
        """Writes what ``squeezefilm solve --out`` writes, and returns the paths. figures: the formats of the figures, ``"svg"``, ``"png"``
        and ``"pdf"``; ``"vtk"`` is the film at every instant for ParaView and PyVista. Raises `SceneError` or `OSError`."""
        return self._inner.save(os.fspath(folder), _text.several(figures))

    def __repr__(self) -> str:
        name, value, _ = next(self._headlines())[1]
        return f"<squeezefilm.Run {self.preset!r}: {name} = {value}>"

    def _headlines(self) -> Iterator[tuple[str, tuple[str, str, str]]]:
        """The numbers of `_HEADLINES` that this run has: for each its words, and its name, its value with error, and its unit."""
        numbers = {**self.summary(), **(self.floating or {})}
        for words, (name, error, unit) in _HEADLINES.items():
            if numbers.get(name) is not None:
                unit = self.force_unit if unit == "force_unit" else unit
                yield words, (name, _squeezefilm.with_error(numbers[name], numbers[error]), unit)

    def _repr_html_(self) -> str:
        rows = [(words, f"{value} {unit}") for words, (_, value, unit) in self._headlines()]
        if not self.converged:
            rows.append(("status", self.status))
        return rows_html((self.preset, ""), rows) + (self.figure(self.figures()[0])._repr_svg_() or "")


class Plot:
    """Drawings of a run in Matplotlib, which has to be installed. Each draws into the axes `ax`, or into new ones, and returns them."""

    def __init__(self, run: Run) -> None:
        self._run = run

    def _axes(self, ax: Any) -> Any:
        if ax is None:
            import matplotlib.pyplot as plt

            ax = plt.subplots(figsize=(8, 3), layout="constrained")[1]
        ax.set_title(self._run.preset)
        return ax

    def _frame(self, phase: float) -> int:
        """The frame nearest to a phase of the cycle."""
        frames = len(self._run.time_s)
        return round(phase * frames) % frames

    def wave(self, phase: float = 0.0, ax: Any = None) -> Any:
        """Heights [nm] of the teeth and of the rotor over one wavelength [mm] at a phase 0 … 1 of the cycle (motors only)."""
        run = self._run
        if "stator_nm" not in run.fields():
            raise AttributeError("a plate has no wave")
        ax, frame = self._axes(ax), self._frame(phase)
        for tooth, middle in enumerate(run.tooth_middle_m):
            x, stator = 1e3 * (middle + run.x_m), run.stator_nm[frame, tooth]
            labels = (None, None) if tooth else ("teeth of the stator", "rotor")
            ax.plot(x, stator, color="C1", label=labels[0])
            ax.plot(x, stator + run.gap_nm[frame, tooth], color="C0", label=labels[1])
        ax.set(xlabel="along the wave (mm)", ylabel="height (nm)", title=f"{run.preset}, t/T = {phase % 1:.2f}")
        ax.legend(loc="upper right")
        return ax

    def loads(self, ax: Any = None) -> Any:
        """Film load and contact load over the cycle, in ``force_unit``, on one wavelength or on the plate."""
        run, ax = self._run, self._axes(ax)
        fields = run.fields()
        for name, words in (("film_load_n", "film"), ("film_load_n_per_m", "film"), ("contact_load_n", "contact")):
            if name in fields:
                ax.plot(np.arange(len(run.time_s)) / len(run.time_s), fields[name][1], label=words)
        ax.set(xlabel="t/T", ylabel=f"load ({run.force_unit})")
        ax.legend()
        return ax

    def pressure(self, phase: float = 0.0, ax: Any = None) -> Any:
        """Absolute pressure [kPa] under the first tooth or the plate at a phase 0 … 1 of the cycle, over x and y [mm]; of a symmetric
        film the half that was solved."""
        run, ax = self._run, self._axes(ax)
        pressure = run.pressure_kpa[self._frame(phase)]
        if min(pressure.shape) < 2:
            ax.plot(1e3 * run.map_x_m, pressure[:, 0])
            ax.set(xlabel="x (mm)", ylabel="pressure (kPa)")
            return ax
        mesh = ax.pcolormesh(1e3 * run.map_x_m, 1e3 * run.map_y_m, pressure.T, shading="nearest")
        ax.figure.colorbar(mesh, ax=ax, label="pressure (kPa)")
        ax.set(xlabel="x (mm)", ylabel="y (mm)")
        return ax
