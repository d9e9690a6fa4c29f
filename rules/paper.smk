"""The paper's results, in its order."""

# First part: kernel, equations, parameters, trilith, allen, statements, verification ---------------


# Second part: spectra, vase, proven, uplift; the animation and the page ----------------------------
