"""Probability of overturning over the intensity of motions, which `topheavy.fragility` estimates.

`estimate` computes the outcomes, `resampling` means and intervals, `curve` the fit and its median,
`tables` the result; `inputs` refuses bad arguments.
"""
