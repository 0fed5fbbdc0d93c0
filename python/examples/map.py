# %% [markdown]
# # A map of a thousand points
#
# α over minimum spacing and frequency, on all cores of this machine; with `client=` on those of a cluster, to the same bytes.

# %%
import time

import matplotlib.pyplot as plt
import numpy as np
import squeezefilm as sf

spacings, frequencies = np.geomspace(50, 500, 40), np.geomspace(3, 100, 25)
started = time.monotonic()
table = sf.sweep(sf.preset("fundamental"), {"film.min_spacing_nm": spacings, "stator.frequency_khz": frequencies})
print(f"{table.rows} points in {time.monotonic() - started:.1f} s, errors up to {table['alpha_error'].max():.4f}")
assert table.rows == 1000 and (table["status"] == "converged").mean() > 0.99

# %%
alpha = table["alpha"].reshape(40, 25)
fig, ax = plt.subplots(layout="constrained")
lines = ax.contour(frequencies, spacings, alpha, levels=np.arange(0.1, 1, 0.1))
ax.clabel(lines)
ax.set(xscale="log", yscale="log", xlabel="frequency (kHz)", ylabel="minimum spacing (nm)", title="share of the load on the film, α")
plt.show()
