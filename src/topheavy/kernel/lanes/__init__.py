"""Many histories at once, one in each lane of the vector registers; `kernel.grid` is the only door.

vectors   the registers of the CPU, within numba
steps     Taylor steps with proven events, as `outcome.advance` takes them
pulses    outcomes of many pulses
records   outcomes of many histories under one record
"""
