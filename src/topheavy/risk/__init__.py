"""Probability of overturning over the intensity of motions, which `topheavy.fragility` estimates.

`estimate` judges the motions, `resampling` gives means and intervals, `curve` the fit and its
median, `tables` the result; `gain` compares medians over γ, and `inputs` refuses bad arguments.
"""
