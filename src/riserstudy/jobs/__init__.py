"""Jobs of the workflow's rules. ``python -m riserstudy.jobs <name>`` runs a function of ``tasks``.

They belong to the package: a checkout and a user's own folder thus run the same code. Every job imports this
file and ``__main__`` in a process of its own, so they import little.
"""

TAKEN = b"+"  # byte with which the server accepts a job
CORES = "RISERSTUDY_CORES"  # environment variable: number of cores that the jobs share
SHARED = 2  # processes per thread that a job claims, on a machine that jobs share
