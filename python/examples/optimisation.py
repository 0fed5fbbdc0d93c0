# %% [markdown]
# # The load with the most stall torque, with SciPy
#
# More load means more friction, but it also closes the gap in which the film carries some of it. `scipy.optimize` sees a run as a function.

# %%
import squeezefilm as sf
from scipy.optimize import minimize_scalar

scene = sf.preset("fundamental").with_(motor_rotor_speed_rpm=0)


def lost(width: float) -> float:
    """The stall torque that is missing at a tooth width [mm]."""
    return -scene.with_(stator_tooth_width_mm=width).solve(accuracy=0.001).stall_torque_nm


best = minimize_scalar(lost, bounds=(0.6, 2.8), method="bounded", options={"xatol": 1e-3})
print(f"SciPy: {-best.fun:.4f} N m at a tooth width of {best.x:.3f} mm, {best.nfev} solves")

# %% [markdown]
# The library has a search of its own, which knows the errors of what it compares.

# %%
found = sf.optimise(scene, {"stator.tooth_width_mm": (0.6, 2.8)}, maximise="stall_torque_nm", accuracy=0.001)
own = found.scene_found.solve(accuracy=0.001).stall_torque_nm
print(f"sf.optimise: {own:.4f} N m at {found.scene_found['stator.tooth_width_mm']:.3f} mm")
assert abs(own + best.fun) < 2e-3
