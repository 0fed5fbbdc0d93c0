"""Scenes: motors and plates."""

from __future__ import annotations

import os
from collections.abc import Mapping
from typing import Any

from . import _squeezefilm, _text
from ._run import Run
from ._table import rows_html


def presets() -> list[str]:
    """Names of the built-in presets."""
    return _squeezefilm.built_in()


def keys() -> dict[str, tuple[str, str]]:
    """Every key that a scene can have, with its unit and its meaning."""
    return {key: (unit, words) for key, unit, words in _squeezefilm.keys()}


def preset(name: str) -> Scene:
    """The built-in preset of this name. Raises `SceneError`, which names the nearest one."""
    return Scene._of(_squeezefilm.Scene.preset(name))


def load(path: str | os.PathLike[str]) -> Scene:
    """The scene of a preset file. Raises `SceneError` with the key, its value and what is allowed."""
    return Scene._of(_squeezefilm.Scene.load(os.fspath(path)))


class Scene:
    """A motor or a plate that can be solved. It does not change: `with_` makes another.

    ``Scene("plate", plate_length_mm=1, plate_mean_gap_um=1, …)`` is one of given keys; those that are optional take their defaults.
    A section can be given as a whole, ``Scene("motor", motor={…}, film={…}, …)``, as ``tomllib`` reads it from a preset file.
    """

    _inner: _squeezefilm.Scene

    def __init__(self, scene: str, /, name: str = "Scene", **keys: Any) -> None:
        given = {"schema": 1, "name": name, "scene": scene}
        given |= {_text.key(key): value for key, value in keys.items() if value is not None}
        text = "\n".join(f"{key} = {_text.toml(value)}" for key, value in given.items())
        self._inner = _squeezefilm.Scene.from_toml(text)

    @classmethod
    def _of(cls, inner: _squeezefilm.Scene) -> Scene:
        scene = cls.__new__(cls)
        scene._inner = inner
        return scene

    @classmethod
    def from_toml(cls, text: str) -> Scene:
        """The scene of a preset file's text."""
        return cls._of(_squeezefilm.Scene.from_toml(text))

    @property
    def name(self) -> str:
        """What it is called."""
        return self._inner.name

    def to_toml(self) -> str:
        """The text of its preset file."""
        return self._inner.to_toml()

    def values(self) -> dict[str, Any]:
        """Its keys with their values, each in the unit of its name; ``None`` where an optional key is absent."""
        return {key: value for key, value, _, _ in self._inner.values()}

    def __getitem__(self, key: str) -> Any:
        """The value of a key, ``scene["film.min_spacing_nm"]``. Raises `KeyError` for a key that the scene does not have."""
        return self.values()[_text.key(key)]

    def with_(self, changes: Mapping[str, Any] | None = None, /, **keys: Any) -> Scene:
        """The same with other values: ``with_(film_min_spacing_nm=100)`` or ``with_({"film.min_spacing_nm": 100})``.

        ``None`` leaves an optional key out. Raises `SceneError`.
        """
        pairs = {**(changes or {}), **keys}
        return Scene._of(self._inner.changed([(_text.key(key), _text.value(value)) for key, value in pairs.items()]))

    def solve(
        self,
        accuracy: float | str | None = None,
        *,
        fidelity: str | None = None,
        method: str = "auto",
        budget_ms: float | None = None,
    ) -> Run:
        """Solves for the periodic steady state.

        accuracy: relative error of the headline, ``0.001`` or ``"0.1%"``; or a `fidelity`, ``"draft"`` to ``"reference"`` (``"standard"``).
        method: ``"auto"``, or ``"paper"`` for the algorithm of Maeno and Bogy. budget_ms: time after which the best so far is returned.

        A run that did not converge is returned with a warning, and ``converged`` false. Raises `SceneError` or `SolveError`.
        """
        return Run(self._inner.solve(_text.how(accuracy, fidelity, method), budget_ms), Scene)

    def __repr__(self) -> str:
        return f"<squeezefilm.Scene {self.name!r}>"

    def _repr_html_(self) -> str:
        rows = ((key, value, unit, words) for key, value, unit, words in self._inner.values() if value is not None)
        return rows_html((self.name, "", "", ""), rows)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Scene) and self.to_toml() == other.to_toml()

    def __hash__(self) -> int:
        return hash(self.to_toml())

    def __reduce__(self) -> tuple[Any, ...]:
        return Scene.from_toml, (self.to_toml(),)
