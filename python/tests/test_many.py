import concurrent.futures
import csv
import io
import multiprocessing
import os
import shutil
import signal
import subprocess

import numpy as np
import pytest
import squeezefilm as sf

SCENE, KEY = sf.preset("fundamental"), "film.min_spacing_nm"
VALUES = np.geomspace(50, 800, 150)


@pytest.fixture(scope="module")
def table():
    return sf.sweep(SCENE, KEY, VALUES, fidelity="draft")


def same(one, other):
    assert list(one) == list(other)
    for column in one:
        assert one[column].tobytes() == other[column].tobytes(), column


def test_a_sweep_is_a_table(table):
    told = []
    few = sf.sweep(SCENE, KEY, VALUES[:8], fidelity="draft", progress=told.append)
    assert table.rows == 150 and np.allclose(table[KEY], VALUES) and told == [i / 8 for i in range(1, 9)]
    assert (np.diff(table["alpha"]) < 0).all() and (table["status"] == "converged").all()
    assert np.array_equal(few["alpha"], table["alpha"][:8])
    assert "150 rows" in repr(table) and "… 150 rows" in table._repr_html_()
    read = list(csv.DictReader(io.StringIO(few.to_csv())))
    assert [float(row["alpha"]) for row in read] == list(few["alpha"]) and read[0]["residual"] == ""


def test_pandas_and_polars_take_it(table):
    pandas = pytest.importorskip("pandas")
    assert pandas.DataFrame(table).set_index(KEY)["alpha"].iloc[0] == table["alpha"][0]
    part = sf._many._part(SCENE, [(KEY, "50:800:150:log")], sf._text.how(None, "draft"), "1/38")
    # docs/python.md: the file of a part is a table below its first line.
    assert list(pandas.read_csv(io.StringIO(part), skiprows=1)["alpha"]) == pytest.approx(list(table["alpha"][:4]), abs=2e-3)
    polars = pytest.importorskip("polars")
    assert polars.DataFrame(table).filter(polars.col("alpha") > 0.5).height == (table["alpha"] > 0.5).sum()


def test_several_keys_and_words():
    table = sf.sweep(SCENE, {"film.slip": ["none", "first-order"], "motor.waves": [6, 7]}, fidelity="draft")
    assert list(table["film.slip"]) == ["none", "none", "first-order", "first-order"]
    assert list(table["motor.waves"]) == [6, 7, 6, 7]
    with pytest.raises(sf.SceneError, match="waves"):
        sf.sweep(SCENE, "motor.waves", [6])
    with pytest.raises(sf.SceneError, match="film.min_spacing_nm = 3"):
        sf.sweep(SCENE, KEY, [3, 100])
    same(sf.sweep(SCENE, KEY, "100:300:3", fidelity="draft"), sf.sweep(SCENE, KEY, "100:300:3:lin", fidelity="draft"))


def test_a_part_of_more_points_than_a_sweep_can_have():
    axes, how = [(KEY, "50:500:10000"), ("stator.frequency_khz", "10:50:1000")], sf._text.how(None, "draft")
    text = sf._many._part(SCENE, axes, how, "50000/100000")
    assert len(text.splitlines()) == 2 + 100
    with pytest.raises(sf.SceneError, match="10000000 points: joined are up to 100000"):
        sf._squeezefilm.join([("it", text)])
    with pytest.raises(sf.SceneError, match="10000000 points: allowed up to 100000, or as many in each part"):
        sf.sweep(SCENE, dict(axes), progress=False)


def test_the_table_has_the_same_bytes_from_any_number_of_workers(table):
    for workers in (1, 3):
        with concurrent.futures.ThreadPoolExecutor(workers) as client:
            same(sf.sweep(SCENE, KEY, VALUES, fidelity="draft", client=client), table)


def test_processes_that_are_forked_after_a_sweep_do_not_wait_for_its_threads(table):
    fork = multiprocessing.get_context("fork")
    with concurrent.futures.ProcessPoolExecutor(2, fork) as client:
        same(sf.sweep(SCENE, KEY, VALUES, fidelity="draft", client=client), table)


def test_a_bar_is_drawn_where_it_is_asked_for(capsys):
    pytest.importorskip("tqdm")
    sf.sweep(SCENE, KEY, [100, 200], fidelity="draft", progress=True)
    assert "100%" in capsys.readouterr().err
    sf.sweep(SCENE, KEY, [100, 200], fidelity="draft")
    assert capsys.readouterr().err == ""


def test_what_a_function_of_progress_raises_ends_the_sweep():
    def stop(share):
        raise RuntimeError("enough")

    with pytest.raises(RuntimeError, match="enough"):
        sf.sweep(SCENE, KEY, VALUES, progress=stop)


def test_a_worker_of_dask_that_is_killed_costs_its_part_only(table):
    distributed = pytest.importorskip("distributed")
    killed = []
    with (
        distributed.LocalCluster(n_workers=2, threads_per_worker=1, processes=True, dashboard_address=None) as cluster,
        distributed.Client(cluster) as client,
    ):
        workers = client.run(os.getpid)

        def kill(share):
            if not killed:
                killed.append(next(iter(workers.values())))
                os.kill(killed[0], signal.SIGKILL)

        same(sf.sweep(SCENE, KEY, VALUES, fidelity="draft", client=client, progress=kill), table)
        assert killed and killed[0] not in client.run(os.getpid).values()


@pytest.mark.skipif("SQUEEZEFILM" not in os.environ and not shutil.which("squeezefilm"), reason="there is no command line")
def test_a_sweep_is_that_of_the_command_line(tmp_path):
    program = os.environ.get("SQUEEZEFILM", "squeezefilm")
    command = [program, "--quiet", "sweep", "fundamental", "--fidelity=draft", f"--vary={KEY}=100,200,300", "--figures=none"]
    subprocess.run([*command, "--out", tmp_path], check=True, stdout=subprocess.DEVNULL)
    same(sf.sweep(SCENE, KEY, [100, 200, 300], fidelity="draft"), sf.Table.of_csv((tmp_path / "sweep.csv").read_text()))
