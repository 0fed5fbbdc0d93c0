"""What docs/performance.md says of Python: what solving from Python costs beyond the solve, and points a second over processes.

    python python/tests/measure.py [PROCESSES]
"""

import concurrent.futures
import multiprocessing
import os
import statistics
import sys
import time

import numpy as np
import squeezefilm as sf
from squeezefilm import _many, _text


def overhead() -> None:
    scene, beyond, solves = sf.preset("fundamental"), [], []
    for _ in range(300):
        started = time.perf_counter()
        run = scene.solve()
        alpha = run.alpha
        beyond.append(time.perf_counter() - started)
        solves.append(run.stats["wall_s"])
        assert alpha > 0
    beyond = [1e3 * (whole - solve) for whole, solve in zip(beyond, solves)]
    quartiles = statistics.quantiles(beyond, n=4)
    print(f"solve {1e3 * statistics.median(solves):.2f} ms, beyond it {quartiles[1]:.3f} ms ({quartiles[0]:.3f} … {quartiles[2]:.3f})")


def each_point() -> None:
    values, scene = np.geomspace(50, 500, 4000), sf.preset("fundamental")
    started = time.process_time()
    table = sf.sweep(scene, "film.min_spacing_nm", values)
    print(f"a sweep of {table.rows} points: {1e3 * (time.process_time() - started) / table.rows:.2f} ms of a core for each")
    started = time.process_time()
    _many._part(scene, [("film.min_spacing_nm", ",".join(map(repr, values.tolist())))], _text.how(None, None), "1/1000")
    print(f"a part with 4 of its points: {1e3 * (time.process_time() - started):.1f} ms of a core")


def throughput(processes: int) -> None:
    # One thread in each process: what a core solves.
    context = multiprocessing.get_context("spawn")
    with concurrent.futures.ProcessPoolExecutor(processes, context, one_thread) as client:
        list(client.map(abs, range(processes)))
        values = np.geomspace(50, 500, 4000)
        sf.sweep(sf.preset("fundamental"), "film.min_spacing_nm", values[:: 4000 // (64 * processes)], client=client)
        started = time.perf_counter()
        table = sf.sweep(sf.preset("fundamental"), "film.min_spacing_nm", values, client=client)
        print(f"{processes} processes: {table.rows / (time.perf_counter() - started):.0f} points a second")


def one_thread() -> None:
    os.environ["RAYON_NUM_THREADS"] = "1"


if __name__ == "__main__":
    overhead()
    each_point()
    for processes in range(1, int(sys.argv[1]) + 1 if len(sys.argv) > 1 else 3):
        throughput(processes)
