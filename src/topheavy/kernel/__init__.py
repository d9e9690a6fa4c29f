"""The compiled kernel: Taylor steps with proven events. Its functions take arrays and numbers.

Time is τ = p t throughout, so that p is in none of its formulas. `history` follows one for
`topheavy.simulate` and `topheavy.judge`; `grid` follows many, in threads, for maps and searches.
"""
