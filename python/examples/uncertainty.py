# %% [markdown]
# # How sure is α? With SALib
#
# Sobol indices of α, if minimum spacing, load and amplitude are each known to ±10 % only: how much of its variance each key makes.

# %%
import numpy as np
import squeezefilm as sf
from SALib.analyze import sobol as analyze
from SALib.sample import sobol as sample

scene = sf.preset("fundamental")
names = ["film.min_spacing_nm", "motor.load_per_wave_n", "stator.normal_amplitude_um"]
problem = {"num_vars": 3, "names": names, "bounds": [[0.9 * scene[name], 1.1 * scene[name]] for name in names]}
drawn = sample.sample(problem, 64, calc_second_order=False, seed=1)
alpha = np.array([scene.with_(dict(zip(names, values))).solve(fidelity="draft").alpha for values in drawn])
indices = analyze.analyze(problem, alpha, calc_second_order=False, seed=1)
print(f"α = {alpha.mean():.4f} ± {alpha.std():.4f}, of {len(drawn)} solves")
for name, first, total in zip(names, indices["S1"], indices["ST"]):
    print(f"{name:28} first order {first:.2f}   total {total:.2f}")

# %% [markdown]
# The library's own derivatives say the same without sampling, as far as α is linear in the keys: ±10 % evenly are ±5.8 % in standard
# deviations.

# %%
found = sf.sensitivity(scene, names, {name: "5.77%" for name in names})
own = next(output for output in found.outputs if output["name"] == "alpha")
print(f"by derivatives: ± {own['uncertainty']:.4f}")
assert abs(own["uncertainty"] / alpha.std() - 1) < 0.15 and abs(indices["ST"].sum() - 1) < 0.15
