"""Results as a research object: the runs, their inputs, outputs and verdicts.

References
----------
RO-Crate 1.1; Workflow Run RO-Crate 0.5 with its profiles process, workflow and provenance (Leo et al. 2024,
PLoS ONE 19, e0309210).
"""
