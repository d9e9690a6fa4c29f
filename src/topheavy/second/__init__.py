"""The other solvers: SciPy, closed forms, three bodies. None reaches the kernel, nor it them."""
