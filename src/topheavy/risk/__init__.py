"""Probability of overturning over the intensity of motions, which `topheavy.fragility` estimates.

`fragility` computes outcomes and tables, `resampling` means and intervals, `curve` the fit and its
median; `inputs` refuses bad arguments.
"""
