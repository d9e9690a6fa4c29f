"""The compiled kernel: Taylor steps with proven events. Its functions take arrays and numbers.

Time is τ = p t throughout, so that p is in none of its formulas. `history` follows one for
`topheavy.simulate` and `topheavy.judge`; `grid` follows many at once for maps and searches, in the
vector registers of the CPU (`lanes`).
"""
