import importlib.resources
import os
import pickle
import shutil
import signal
import subprocess
import threading
import time

import numpy as np
import pytest
import squeezefilm as sf


@pytest.fixture(scope="module")
def run():
    return sf.preset("fundamental").solve(fidelity="draft")


def test_a_run_is_that_of_the_command_line():
    run = sf.preset("fundamental").solve(accuracy=0.001)
    # docs/validation.md: 0.24586 ± 0.00005
    assert abs(run.alpha - 0.24586) < run.alpha_error + 5e-5 and run.alpha_error < 0.0003
    assert run.converged and run.accuracy_asked == 0.001
    assert [limit["name"] for limit in run.validity] == ["slip-law"]
    assert run.film_load_n == pytest.approx(run.alpha * 2.45)
    assert "0.2458" in repr(run) or "0.2459" in repr(run)
    assert run.merit["with_film"]["no_load_speed_rpm"] > 0


def test_fields_have_the_shapes_of_their_axes(run):
    length = {}
    for name, (axes, array) in run.fields().items():
        assert array.dtype == np.float64 and array.ndim == len(axes)
        for axis, size in zip(axes, array.shape):
            assert length.setdefault(axis, size) == size, name
    load = (run.film_n_per_m * run.node_length_m).sum(axis=(1, 2))
    assert np.allclose(load, run.fields()["film_load_n"][1])
    assert run.fields()["film_load_n"][1].mean() == pytest.approx(run.film_load_n)
    assert run.pressure_kpa.min() > 0
    # A view of what the library handed over, made once; xarray has the same.
    assert run.pressure_kpa is run.pressure_kpa and not run.pressure_kpa.flags.owndata
    with pytest.raises(AttributeError, match="presure"):
        run.presure_kpa


def test_types_and_docs_name_what_there_is(run):
    assert importlib.resources.files(sf).joinpath("py.typed").is_file()
    source = importlib.resources.files(sf).joinpath("_run.py").read_text()
    declared = source.split("if TYPE_CHECKING:\n        preset")[1].split("def __init__")[0]
    names = {"preset", *(line.split(":")[0].strip() for line in declared.splitlines()[1:] if ":" in line)}
    there = {*run.summary(torque=True), *run.fields()}
    assert names - there == set()
    # What is not declared is costs, limits, and series that have the name of their mean.
    assert {name for name, (axes, _) in run.fields().items() if len(axes) > 1 or axes[0] != "frame"} <= names
    table = sf.Run.__doc__
    assert all(name in table for name, (axes, _) in run.fields().items() if axes != ("frame",))
    for name in sf.__all__:
        assert name in ("CHUNK", "__version__") or getattr(sf, name).__doc__, name


def test_keys_are_changed_and_a_scene_stays():
    scene = sf.preset("fundamental")
    smoother = scene.with_(film_min_spacing_nm=100)
    assert (smoother["film.min_spacing_nm"], scene["film_min_spacing_nm"]) == (100, 200)
    assert smoother.solve().alpha == pytest.approx(0.499, abs=0.01)
    crowned = scene.with_({"stator.tooth_radius_m": 3})
    assert crowned != scene and crowned.with_(stator_tooth_radius_m=None).solve().alpha == scene.solve().alpha
    assert pickle.loads(pickle.dumps(smoother)) == smoother
    assert "min_spacing_nm" in scene._repr_html_() and sf.keys()["film.min_spacing_nm"][0] == "nm"


def test_a_scene_is_made_of_keys_of_a_file_or_of_sections(tmp_path):
    fundamental = sf.preset("fundamental")
    (tmp_path / "my.toml").write_text(fundamental.to_toml())
    loaded = sf.load(tmp_path / "my.toml")
    assert loaded == fundamental
    table = pytest.importorskip("tomllib").loads(fundamental.to_toml())
    sections = {name: value for name, value in table.items() if isinstance(value, dict)}
    made = sf.Scene(table["scene"], table["name"], about=table["about"], **sections)
    assert made == fundamental
    plate = sf.Scene("plate", plate_length_mm=1, plate_mean_gap_um=1, plate_amplitude_um=0.5, plate_frequency_khz=30)
    assert plate.solve(fidelity="draft").mean_load_ratio > 0 and plate["plate.width_mm"] is None
    with pytest.raises(sf.SceneError, match="plate.length_mm"):
        sf.Scene("plate", plate_length_mm=-1, plate_mean_gap_um=1, plate_amplitude_um=0.5, plate_frequency_khz=30)
    with pytest.raises(sf.SceneError, match="plate.length_mm"):
        sf.Scene("plate", plate_length=1)


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
    with pytest.raises(sf.SceneError, match="accuracy = 3"):
        sf.preset("fundamental").solve(accuracy=3)
    with pytest.raises(sf.SceneError, match="fidelity"):
        sf.preset("fundamental").solve(0.01, fidelity="fine")
    with pytest.raises(sf.SceneError, match="method = magic"):
        sf.preset("fundamental").solve(method="magic")
    with pytest.raises(sf.SceneError, match="plate"):
        sf.preset("plate-trapped").solve(method="paper")
    for budget in (-1, float("nan"), float("inf")):
        with pytest.raises(sf.SceneError, match="budget_ms = .* is out of range: allowed 0.001 to 86400000"):
            sf.preset("fundamental").solve(budget_ms=budget)


@pytest.mark.skipif("SQUEEZEFILM" not in os.environ and not shutil.which("squeezefilm"), reason="there is no command line")
@pytest.mark.parametrize("setting", ["film.min_spacing_nm=-1", "film.min_spacing=3", "film.slip=cubic", "motor.waves=6.5", "film.gas=neon"])
def test_a_message_is_that_of_the_command_line(setting):
    program = os.environ.get("SQUEEZEFILM", "squeezefilm")
    told = subprocess.run([program, "solve", "fundamental", "--set", setting], capture_output=True, text=True).stderr
    with pytest.raises(sf.SceneError) as raised:
        sf.preset("fundamental").with_(dict([setting.split("=")])).solve()
    assert told == f"error: {raised.value}\n"


def test_ctrl_c_ends_what_takes_long():
    # A shell starts what is in its background with the signal ignored.
    signal.signal(signal.SIGINT, signal.default_int_handler)
    mesh = {"film_nodes_along": 201, "film_nodes_across": 41, "contact_nodes": 1441, "steps_per_cycle": 1440}
    hard = sf.preset("fundamental").with_({f"numerics.{key}": value for key, value in mesh.items()})
    for work in (lambda: hard.solve(method="paper"), lambda: sf.sweep(hard, "motor.waves", [6, 7, 8], method="paper")):
        timer = threading.Timer(0.3, signal.raise_signal, [signal.SIGINT])
        timer.start()
        with pytest.raises(KeyboardInterrupt):
            work()
        timer.join()


def test_other_threads_of_python_run_while_it_is_solved():
    counted, ended = [0], threading.Event()

    def count():
        while not ended.is_set():
            counted[0] += 1
            time.sleep(0.001)

    thread = threading.Thread(target=count)
    thread.start()
    before = counted[0]
    sf.sweep(sf.preset("fundamental"), "film.min_spacing_nm", np.linspace(50, 500, 200))
    during = counted[0] - before
    ended.set()
    thread.join()
    assert during > 5


def test_what_does_not_converge_is_returned_with_a_warning():
    # A single cycle at most.
    scene = sf.preset("min-spacing-100nm").with_(film_min_spacing_nm=20)
    keys = {"numerics.film_nodes_along": 21, "numerics.film_nodes_across": 7, "numerics.contact_nodes": 91, "numerics.steps_per_cycle": 60}
    with pytest.warns(RuntimeWarning, match="not converged"):
        run = scene.with_(keys).solve(method="paper")
    assert not run.converged and run.residual > run.tolerance and "not converged" in run._repr_html_()


def test_a_notebook_shows_numbers_and_the_wave(run):
    shown = run._repr_html_()
    assert f"{run.alpha:.4f} ± {run.alpha_error:.4f}" in shown and "<svg" in shown and len(shown) < 200_000
    plate = sf.preset("plate-trapped").solve(fidelity="draft")
    assert "<svg" in plate._repr_html_() and plate.mean_load_ratio > 0
    floating = sf.preset("floating-disc").solve(fidelity="draft")
    gap = f"{floating.floating['mean_gap_um']:.4f}"
    assert f"mean_gap_um = {gap}" in repr(floating) and f"it floats</td><td>{gap}" in floating._repr_html_()


def test_figures_are_those_of_the_library(run, tmp_path):
    assert run.figures()[:3] == ["wave", "loads", "map"] and "torque" in run.figures()
    wave = run.figure("wave")
    assert wave._repr_svg_().startswith("<svg") and wave._repr_png_() is None
    assert run.figure("loads", "png").data.startswith(b"\x89PNG") and run.figure("torque", "pdf").data.startswith(b"%PDF")
    assert run.figure(tmp_path / "wave.svg").data == (tmp_path / "wave.svg").read_bytes() == wave.data
    with pytest.raises(sf.SceneError, match="figure = waves is not there: one of wave"):
        run.figure("waves")
    with pytest.raises(sf.SceneError, match="format = bmp is not allowed"):
        run.figure("wave.bmp")
    with pytest.raises(sf.SceneError, match="figures = bmp is not allowed: one of svg, png, pdf, vtk"):
        run.save(tmp_path / "results", figures=("svg", "bmp"))
    written = run.save(tmp_path / "results", figures="svg")
    assert {"fields.npz", "summary.json", "torque.csv", "wave.svg"} <= {path.rsplit("/", 1)[-1] for path in written}
    fields = np.load(tmp_path / "results" / "fields.npz")
    assert all(np.array_equal(fields[name], array) for name, (_, array) in run.fields().items())
    with pytest.raises(OSError):
        run.save("/dev/null/results")


@pytest.mark.parametrize("name", ["fundamental", "plate-crossover", "plate-trapped", "floating-disc"])
def test_vtk_is_read_by_pyvista(name, tmp_path):
    pyvista = pytest.importorskip("pyvista")
    run = sf.preset(name).solve(fidelity="draft")
    run.save(tmp_path, figures=("vtk",))
    reader = pyvista.get_reader(tmp_path / "film.vtk.series")
    assert reader.time_values == list(run.time_s)
    frame = len(run.time_s) // 3
    reader.set_active_time_point(frame)
    mesh = reader.read()
    # What is on one tooth now is on the first at other instants.
    teeth = run.tooth_middle_m.size if name == "fundamental" else 1
    pressure = run.pressure_kpa[(frame + len(run.time_s) // teeth * np.arange(teeth)) % len(run.time_s)]
    assert mesh.get_data_range("pressure_kpa") == pytest.approx((pressure.min(), pressure.max()), rel=1e-6)
    areas = mesh.compute_cell_sizes(length=False, volume=False)["Area"]
    means = mesh.point_data_to_cell_data()
    below = means["face"] == 0
    assert set(mesh.celltypes) == {pyvista.CellType.QUAD} and (areas > 0).all() and 2 * below.sum() == len(areas)
    force = 1e-3 * (areas * (means["pressure_kpa"] - run.scene["film.ambient_pressure_kpa"]))[below].sum()
    warped = mesh.warp_by_vector("height_mm", factor=1000)
    assert np.allclose(warped.points, mesh.points + 1000 * mesh["height_mm"]) and np.ptp(warped.points[:, 2]) > 1e-3
    if name == "fundamental":
        expected = run.scene["motor.waves"] * run.fields()["film_load_n"][1][frame]
        assert abs(np.linalg.norm(mesh.points[:, :2], axis=1) - 29).max() < 0.2
        stator, rotor = (warped.points[mesh["face"] == face, 2] for face in (0, 1))
        gap = 1e3 * (rotor - stator)
        assert np.allclose(gap + run.scene["film.min_spacing_nm"], mesh["film_thickness_nm"][mesh["face"] == 0], atol=0.1)
    elif "film_load_n_per_m" in run.fields():
        # A strip is drawn as wide as it is long.
        expected = 1e-3 * run.scene["plate.length_mm"] * run.fields()["film_load_n_per_m"][1][frame]
    else:
        expected = run.fields()["film_load_n"][1][frame]
    assert force == pytest.approx(expected, rel=0.05, abs=0.02 * abs(run.film_load_n))


def test_xarray(run, tmp_path):
    xarray = pytest.importorskip("xarray")
    pytest.importorskip("scipy")
    data = run.to_xarray()
    assert isinstance(data, xarray.Dataset) and data.pressure_kpa.dims == ("frame", "map_x", "map_y")
    assert np.shares_memory(data.pressure_kpa.values, run.pressure_kpa)
    assert (data.pressure_kpa.units, data.film_n_per_m.units, data.stator_nm.units) == ("kPa", "N/m", "nm")
    assert sf.preset("plate-trapped").solve(fidelity="draft").to_xarray().pressure_kpa.size
    data.to_netcdf(tmp_path / "run.nc", engine="scipy")
    with xarray.open_dataset(tmp_path / "run.nc", engine="scipy", decode_times=False) as read:
        assert np.array_equal(read.pressure_kpa, run.pressure_kpa) and read.attrs["preset"] == run.preset


def test_plots(run):
    matplotlib = pytest.importorskip("matplotlib")
    matplotlib.use("Agg")
    axes = run.plot.wave(phase=0.3)
    assert len(axes.lines) == 2 * len(run.tooth_middle_m) and "0.30" in axes.get_title()
    heights = axes.lines[0].get_ydata()
    assert np.array_equal(heights, run.stator_nm[round(0.3 * len(run.time_s)), 0])
    assert [line.get_label() for line in run.plot.loads().lines] == ["film", "contact"]
    assert run.plot.pressure(0.5).collections
    plate = sf.preset("plate-crossover").solve(fidelity="draft")
    assert plate.plot.pressure().lines or plate.plot.pressure().collections
    with pytest.raises(AttributeError, match="no wave"):
        plate.plot.wave()
