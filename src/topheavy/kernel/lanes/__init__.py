"""Many histories at once, one in each lane of the vector registers; only `kernel.grid` calls it.

vectors   the registers of the CPU, within numba
steps     Taylor steps with proven events, as `step.advance` takes them
pulses    outcomes of many pulses
records   outcomes of many histories under one record
"""
