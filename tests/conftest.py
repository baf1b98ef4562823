"""Shared by all tests; being here, it also lets them import ``strategies``."""

from hypothesis import HealthCheck, settings

# Seeded by the test itself, so that a run can be repeated; no deadline, since kernels may compile.
settings.register_profile(
    "riserstudy",
    deadline=None,
    derandomize=True,
    max_examples=30,
    suppress_health_check=[HealthCheck.too_slow],
)
settings.load_profile("riserstudy")
