import concurrent.futures
import pickle
import signal
import threading
import time

import numpy as np
import pytest
import squeezefilm as sf


def test_a_run_is_that_of_the_command_line():
    run = sf.preset("fundamental").solve(accuracy=0.001)
    # docs/validation.md: 0.24586 ± 0.00005
    assert abs(run.alpha - 0.24586) < run.alpha_error + 5e-5 and run.alpha_error < 0.0003
    assert run.converged and run.validity == [] and run.accuracy_asked == 0.001
    assert run.film_load_n == pytest.approx(run.alpha * 2.45)
    assert "0.2458" in repr(run) or "0.2459" in repr(run)


def test_fields_have_the_shapes_of_their_axes():
    run = sf.preset("fundamental").solve(fidelity="draft")
    length = {}
    for name, (axes, array) in run.fields().items():
        assert array.dtype == np.float64 and array.ndim == len(axes)
        for axis, size in zip(axes, array.shape):
            assert length.setdefault(axis, size) == size, name
    load = (run.film_n_per_m * run.node_length_m).sum(axis=(1, 2))
    assert np.allclose(load, run.fields()["film_load_n"][1])
    assert run.fields()["film_load_n"][1].mean() == pytest.approx(run.film_load_n)
    assert run.pressure_kpa.min() > 0
    with pytest.raises(AttributeError, match="presure"):
        run.presure_kpa


def test_keys_are_changed_and_a_scene_stays():
    scene = sf.preset("fundamental")
    smoother = scene.with_(film_min_spacing_nm=100)
    assert "min_spacing_nm = 100" in smoother.to_toml() and "min_spacing_nm = 100" not in scene.to_toml()
    assert smoother.solve().alpha == pytest.approx(0.499, abs=0.01)
    assert scene.with_({"stator.tooth_radius_m": 3}).with_(stator_tooth_radius_m=None).solve().alpha == scene.solve().alpha
    assert pickle.loads(pickle.dumps(smoother)).to_toml() == smoother.to_toml()


@pytest.mark.parametrize("key, value", [("film_min_spacing_nm", -1), ("film_min_spacing", 100), ("film_slip", "cubic")])
def test_bad_input_names_key_and_value(key, value):
    with pytest.raises(sf.SceneError, match=key.replace("_", ".", 1)):
        sf.preset("fundamental").with_({key: value})
    assert issubclass(sf.SceneError, ValueError)


def test_bad_names_and_settings():
    with pytest.raises(sf.SceneError, match="fundamental"):
        sf.preset("fundamentel")
    with pytest.raises(sf.SceneError, match="nowhere.toml"):
        sf.load("nowhere.toml")
    with pytest.raises(ValueError, match="accuracy = 3"):
        sf.preset("fundamental").solve(accuracy=3)
    with pytest.raises(ValueError, match="fidelity"):
        sf.preset("fundamental").solve(0.01, fidelity="fine")


def test_a_sweep_is_a_table_and_the_same_from_any_number_of_workers():
    scene, values = sf.preset("fundamental"), np.geomspace(50, 800, 70)
    told = []
    table = sf.sweep(scene, "film.min_spacing_nm", values, fidelity="draft", progress=told.append)
    assert table.rows == 70 and np.allclose(table["film.min_spacing_nm"], values) and told[-1] == 1
    assert (np.diff(table["alpha"]) < 0).all()
    with concurrent.futures.ThreadPoolExecutor(1) as one, concurrent.futures.ThreadPoolExecutor(3) as three:
        by_one, by_three = (
            sf.sweep(scene, "film.min_spacing_nm", values, fidelity="draft", client=client) for client in (one, three)
        )
    for column in by_one:
        assert by_one[column].tobytes() == by_three[column].tobytes(), column
    # Where a chunk begins cold, it differs from the whole by less than the stated errors.
    assert (abs(by_one["alpha"] - table["alpha"]) <= table["alpha_error"]).all()


def test_sensitivity():
    found = sf.sensitivity(sf.preset("fundamental"), ["film.min_spacing_nm"], {"film.min_spacing_nm": "10%"})
    assert "film.min_spacing_nm" in str(found)


def test_ctrl_c_ends_a_solve():
    hard = sf.preset("fundamental").with_(film_min_spacing_nm=5, numerics_steps_per_cycle=20000, numerics_teeth="all")
    threading.Timer(0.3, signal.raise_signal, [signal.SIGINT]).start()
    started = time.monotonic()
    with pytest.raises(KeyboardInterrupt):
        hard.solve(fidelity="reference")
    assert time.monotonic() - started < 20


def test_a_notebook_shows_numbers_and_the_wave():
    shown = sf.preset("fundamental").solve(fidelity="draft")._repr_html_()
    assert "±" in shown and shown.count("<polyline") == 10
    plate = sf.preset("plate-trapped").solve(fidelity="draft")
    assert "<svg" not in plate._repr_html_() and plate.mean_load_ratio > 0


def test_xarray():
    xarray = pytest.importorskip("xarray")
    data = sf.preset("fundamental").solve(fidelity="draft").to_xarray()
    assert isinstance(data, xarray.Dataset) and data.pressure_kpa.dims == ("frame", "map_x", "map_y")
