"""The squeezed air film of ultrasonic motors, solved, with an error for every number.

>>> import squeezefilm as sf
>>> run = sf.preset("fundamental").with_(film_min_spacing_nm=100).solve(accuracy=0.001)
>>> run.alpha, run.alpha_error

Keys are those of the command line, with an underscore for the dot: ``film_min_spacing_nm`` is ``film.min_spacing_nm``. Numbers of a
run are those of ``squeezefilm solve --json``, fields those of ``fields.npz``; all have their unit in the name.

Whatever takes long lets other threads of Python run, ends at Ctrl-C, and takes ``progress``: a function that is told how much is done,
``True`` for a bar of tqdm, ``False`` for none; where nothing is said there is a bar in a notebook, if tqdm is installed.

What is wrong with an input is told by a `SceneError`, which is a `ValueError`: the key, its value and what is allowed.
"""

from ._many import CHUNK, sweep
from ._run import Figure, Plot, Run
from ._scene import Scene, keys, load, preset, presets
from ._squeezefilm import SceneError, SolveError, __version__
from ._studies import Found, fit, hold, optimise, sensitivity, startup
from ._table import Table

__all__ = [
    "CHUNK",
    "Figure",
    "Found",
    "Plot",
    "Run",
    "Scene",
    "SceneError",
    "SolveError",
    "Table",
    "__version__",
    "fit",
    "hold",
    "keys",
    "load",
    "optimise",
    "preset",
    "presets",
    "sensitivity",
    "startup",
    "sweep",
]
