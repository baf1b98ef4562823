"""Number of threads of the linear algebra libraries (BLAS)."""

import os

#: environment variables that the libraries read when they are loaded: NumPy and SciPy have one library each
THREADS = ("OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "BLIS_NUM_THREADS", "VECLIB_MAXIMUM_THREADS")


def use_one_thread() -> None:
    """Limit libraries that this process loads from now on to one thread, unless the user chose otherwise.

    Threads of processes that share cores wait for each other in loops that occupy a core. With two processes
    on two cores, an eigenvalue problem of 400 unknowns takes up to a hundred times as long as with one
    thread.
    """
    if "OMP_NUM_THREADS" not in os.environ:
        for name in THREADS:
            os.environ.setdefault(name, "1")
