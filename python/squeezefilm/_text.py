"""Keys and values as the command line takes them."""

from __future__ import annotations

import json
from collections.abc import Iterable, Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from ._squeezefilm import How


def value(given: Any) -> str:
    """A value as ``--set`` takes it."""
    if isinstance(given, (bool, np.bool_)):
        return "true" if given else "false"
    if given is None:
        return "none"
    return repr(float(given)) if isinstance(given, (float, np.floating)) else str(given)


def key(name: str) -> str:
    """``film_min_spacing_nm`` as ``film.min_spacing_nm``; a key with a dot stays as it is."""
    return name if "." in name or "_" not in name else name.replace("_", ".", 1)


def toml(given: Any) -> str:
    """A value as a preset file has it."""
    if isinstance(given, Mapping):
        return "{" + ", ".join(f"{name} = {toml(inner)}" for name, inner in given.items() if inner is not None) + "}"
    if isinstance(given, (list, tuple, np.ndarray)):
        return "[" + ", ".join(map(toml, given)) + "]"
    # A text of JSON is one of TOML.
    return json.dumps(given, ensure_ascii=False) if isinstance(given, str) else value(given)


def several(given: Iterable[str]) -> list[str]:
    """A list of texts. A single text stands for a list of one."""
    return [given] if isinstance(given, str) else list(given)


def how(accuracy: float | str | None, fidelity: str | None, method: str = "auto") -> How:
    """How to solve."""
    return {"accuracy": None if accuracy is None else str(accuracy), "fidelity": None if fidelity is None else str(fidelity), "method": str(method)}
