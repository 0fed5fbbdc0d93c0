# %% [markdown]
# # A torque–speed curve against measured points
#
# Torques were measured at eight speeds of a motor whose friction and whose tangential amplitude are not well known. Here the points are
# made: computed with a friction of 0.6 and 1.1 µm, with 1 % of noise. The fit has to find both again.

# %%
import numpy as np
import squeezefilm as sf

motor = sf.preset("fundamental").with_(motor_dry_friction=0.6, stator_tangential_amplitude_um=1.1)
speeds = np.linspace(0, 50, 8)
curve = motor.solve().torque()
torque = np.interp(speeds, curve["speed_rpm"], curve["torque_nm"])
torque *= 1 + 0.01 * np.random.default_rng(1).standard_normal(8)

# %%
vary = {"motor.dry_friction": (0.3, 1.0), "stator.tangential_amplitude_um": (0.5, 2.0)}
found = sf.fit(sf.preset("fundamental"), {"rotor_speed_rpm": speeds, "torque_nm": torque}, vary)
for unknown, true in zip(found.unknowns, (0.6, 1.1)):
    print(f"{unknown['key']} = {unknown['value']:.3f} ± {unknown['standard_error']:.3f}, made with {true}")
    assert abs(unknown["value"] - true) < 4 * unknown["standard_error"]

# %%
import matplotlib.pyplot as plt

rows = found.table()
fig, ax = plt.subplots(layout="constrained")
ax.errorbar(rows["rotor_speed_rpm"], rows["measured"], rows["error"], fmt="o", label="measured")
ax.plot(rows["rotor_speed_rpm"], rows["computed"], label="computed with the values found")
ax.set(xlabel="speed of the rotor (rpm)", ylabel="torque (N m)")
ax.legend()
plt.show()
