"""Outcomes of structures by the kernel: histories, overturning maps, intervals, minima."""
