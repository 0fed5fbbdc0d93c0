# %% [markdown]
# # Table I in ten lines
#
# The film's share of the load, α, as Maeno and Bogy published it in 1992, beside what is computed with the same numbers, but for the
# meshes: what is published is that of coarse ones (`squeezefilm table1` solves on them too).

# %%
from pathlib import Path

import squeezefilm as sf

published = sf.Table.of_csv((Path(__file__).parents[2] / "assets/table1.csv").read_text())
for row, alpha in zip(published["row"], published["published_alpha"]):
    run = sf.preset(row.replace("_", "-")).solve()
    print(f"{row:22} published {alpha:.3f}   computed {run.alpha:.4f} ± {run.alpha_error:.4f}")
    assert abs(run.alpha - alpha) < 0.06
