"""Draw measured and computed thresholds, and how often tests of each probability overturned."""

import json
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd

numbers = json.loads(Path("results/numbers.json").read_text())["blocks"]
peaks = pd.read_csv("results/thresholds.csv")
plt.rcParams.update({"font.size": 8, "svg.hashsalt": "shake table"})
figure, axes = plt.subplots(1, 3, figsize=(6.7, 2.3), layout="constrained")
for block, marker, color in ((1, "o", "#c8501a"), (2, "s", "#1f4e79")):
    style = {"marker": marker, "color": color, "markersize": 3.5, "linestyle": ""}
    motions, axis = peaks[peaks.block == block], axes[block - 1]
    axis.loglog(motions.measured, motions.computed, **style)
    axis.set(title=f"Block {block}", xlabel="Measured peak (g)", ylabel="Computed peak (g)")
    axes[2].plot(*np.transpose(numbers[block - 1]["calibration"]), **style, label=f"block {block}")
axes[2].set(title="Calibration", xlabel="Computed probability (–)", ylabel="Share overturned (–)")
axes[2].legend(frameon=False)
for axis, ends in zip(axes, ([0.07, 2.5], [0.07, 2.5], [0, 1]), strict=True):
    axis.plot(ends, ends, color="black", linewidth=0.6)
figure.savefig("results/figure.svg", metadata={"Date": None})
