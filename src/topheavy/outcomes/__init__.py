"""What becomes of a structure by the kernel: histories, overturning maps, intervals, minima."""
