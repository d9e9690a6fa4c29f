"""The solver by SciPy. It does not import the kernel, and the kernel does not import it."""
