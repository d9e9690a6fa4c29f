"""Draw the share of the factors within 5 % that overturn the bent, and one column alone."""

import matplotlib.pyplot as plt
import numpy as np

factors, bent, column = np.loadtxt("results/outcomes.csv").T
window = np.searchsorted(factors, 1.05 * factors[0])
figure, axis = plt.subplots(figsize=(6.3, 2.2), layout="constrained")
for overturned, label in ((column, "one column alone"), (bent, "bent")):
    share = 100 * np.convolve(overturned, np.ones(window) / window, "valid")
    axis.plot(factors[: share.size], share, label=label)
axis.set(xlabel="Factor on the record (–)", ylabel="Overturned (%)")
axis.legend(frameon=False)
figure.savefig("results/capacity.svg", metadata={"Date": None})
