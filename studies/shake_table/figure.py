"""Draw measured and computed thresholds, and how often tests of each probability overturned."""

import json
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np

plt.rcParams.update({"font.size": 8, "svg.hashsalt": "shake table"})
figure, axes = plt.subplots(1, 3, figsize=(6.7, 2.3), layout="constrained")
blocks = json.loads(Path("results/numbers.json").read_text())["blocks"]
for k, marker, color in ((0, "o", "#c8501a"), (1, "s", "#1f4e79")):
    style = {"marker": marker, "color": color, "markersize": 3.5, "linestyle": ""}
    axes[k].loglog(*np.transpose(blocks[k]["thresholds"]), **style)
    axes[k].set(title=f"Block {k + 1}", xlabel="Measured peak (g)", ylabel="Computed peak (g)")
    axes[2].plot(*np.transpose(blocks[k]["calibration"]), **style, label=f"block {k + 1}")
axes[2].set(title="Calibration", xlabel="Computed probability (–)", ylabel="Share overturned (–)")
axes[2].legend(frameon=False)
for axis, ends in zip(axes, ([0.07, 2.5], [0.07, 2.5], [0, 1]), strict=True):
    axis.plot(ends, ends, color="black", linewidth=0.6)
figure.savefig("results/figure.svg", metadata={"Date": None})
