"""The compiled kernel: Taylor steps with proven events. It knows arrays and floats, no structures.

Time is τ = p t throughout, so that p is in none of its formulas. The layers above are
`topheavy.simulate`, which follows one history (`outcome`, `trace`), and `outcomes.overturning`,
which follows many at once in the vector registers of the CPU (`grid`, the door to `lanes`).
"""
