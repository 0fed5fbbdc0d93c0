import numpy as np
import pytest
import squeezefilm as sf

SCENE = sf.preset("fundamental")


def test_sensitivity():
    found = sf.sensitivity(SCENE, ["film.min_spacing_nm"], {"film_min_spacing_nm": "10%"}, fidelity="draft", draws=8)
    alpha = next(output for output in found.outputs if output["name"] == "alpha")
    derivative = alpha["by"][0]
    assert derivative["key"] == "film.min_spacing_nm" and derivative["derivative"] < 0
    assert found.monte_carlo["solved"] == 8 and found["converged"]
    with pytest.raises(sf.SceneError, match="unknown key film.min_spacing: did you mean film.min_spacing_nm"):
        sf.sensitivity(SCENE, "film.min_spacing")
    with pytest.raises(sf.SceneError, match="draws = -1 is out of range: allowed 2 to 1000000"):
        sf.sensitivity(SCENE, "film.min_spacing_nm", draws=-1)


def test_a_fit_finds_the_key_that_the_measurements_were_made_with():
    made = SCENE.with_(motor_dry_friction=0.55)
    load = [made.with_(motor_load_per_wave_n=newton).solve().stall_torque_nm for newton in (1.5, 2.45, 4)]
    data = {"motor.load_per_wave_n": [1.5, 2.45, 4], "stall_torque_nm": load, "stall_torque_nm_error": [1e-4] * 3}
    found = sf.fit(SCENE, data, {"motor.dry_friction": (0.1, 1.0)})
    unknown = found.unknowns[0]
    assert found.converged and unknown["key"] == "motor.dry_friction"
    assert unknown["value"] == pytest.approx(0.55, abs=1e-3)
    assert found.scene_found["motor.dry_friction"] == pytest.approx(unknown["value"])
    rows = found.table()
    assert rows.rows == 3 and abs(rows["residual"]).max() < 1 and "motor.dry_friction" in found._repr_html_()
    pandas = pytest.importorskip("pandas")
    again = sf.fit(SCENE, pandas.DataFrame(data), {"motor_dry_friction": (0.1, 1.0, "lin")})
    # Searched by equal steps, not by equal ratios.
    assert again.unknowns[0]["value"] == pytest.approx(unknown["value"], rel=1e-9)


def test_table_1_is_there_to_be_fitted_and_bad_tables_are_told(tmp_path):
    told = []
    found = sf.fit(SCENE, "table1", {"film.min_spacing_nm": (100, 400)}, fidelity="draft", progress=told.append)
    assert found.data == "Table I" and 150 < found.unknowns[0]["value"] < 250 and told
    (tmp_path / "data.csv").write_text("film_load,motor.waves\n1,7\n")
    with pytest.raises(sf.SceneError, match="film_load"):
        sf.fit(SCENE, tmp_path / "data.csv", {"film.min_spacing_nm": (100, 400)})
    with pytest.raises(sf.SceneError, match="film.min_spacing_nm=100"):
        sf.fit(SCENE, "table1", {"film.min_spacing_nm": (100,)})
    with pytest.raises(sf.SceneError, match="columns of different lengths: {'motor.load_per_wave_n': 2, 'alpha': 1}"):
        sf.fit(SCENE, {"motor.load_per_wave_n": [1, 2], "alpha": [0.3]}, {"film.min_spacing_nm": (100, 400)})
    with pytest.raises(sf.SceneError, match="starts = 0 is out of range: allowed 1 to 10000"):
        sf.fit(SCENE, "table1", {"film.min_spacing_nm": (100, 400)}, starts=0)


def test_an_optimum():
    vary = {"motor.load_per_wave_n": (0.5, 10)}
    found = sf.optimise(SCENE, vary, maximise="stall_torque_nm", subject_to=["max_pressure_kpa<200"], fidelity="draft")
    value = found.scene_found.solve(fidelity="draft")
    assert value.stall_torque_nm > SCENE.solve(fidelity="draft").stall_torque_nm and value.max_pressure_kpa < 205
    with pytest.raises(sf.SceneError, match="give one of them"):
        sf.optimise(SCENE, vary)
    with pytest.raises(sf.SceneError, match="torque"):
        sf.optimise(SCENE, vary, maximise="torque")


def test_a_start_up_ends_where_the_periodic_solve_says():
    told = []
    found = sf.startup(SCENE, fidelity="draft", progress=told.append)
    cycles = found.table()
    assert found.converged and cycles.rows > 2 and list(cycles["cycle"]) == list(range(1, cycles.rows + 1)) and told
    assert abs(cycles["alpha"][-1] - found.steady) < found.steady_error + cycles["alpha_error"][-1] + 2e-3
    dropped = sf.startup(sf.preset("floating-disc"), cycles=5, fidelity="draft")
    assert not dropped.converged and dropped.table()["height_um"].size == 6
    for bad in ({"cycles": 0}, {"tolerance": 1}):
        with pytest.raises(sf.SceneError, match="is out of range"):
            sf.startup(SCENE, **bad)


def test_a_held_plate_is_pressed_apart_when_it_is_pushed_together():
    plate = sf.preset("plate-crossover")
    gap = plate["plate.mean_gap_um"]
    times = np.linspace(0, 1e-4, 11)
    table = sf.hold(plate, times, gap * (1 - 0.5 * times / times[-1]))
    force = table["force_n" if plate["plate.width_mm"] else "force_n_per_m"]
    assert table.rows == 11 and force[0] == 0
    assert (np.diff(force) > 0).all() and table["mean_pressure_kpa"][-1] > 101.325
    # In next to no time nothing flows: Boyle.
    fast = sf.hold(plate, [0, 1e-9], [gap, 0.5 * gap])
    assert fast["load_ratio"][-1] == pytest.approx(1.0, rel=0.02)
    with pytest.raises(sf.SceneError, match="gap_um = 1000"):
        sf.hold(plate, [0, 1], [gap, 1000])
    with pytest.raises(sf.SceneError, match="ascending"):
        sf.hold(plate, [1, 0], [gap, gap])
    with pytest.raises(sf.SceneError, match="scene = motor"):
        sf.hold(SCENE, [0], [1])
