"""Shared by all tests; being here, it also lets them import ``strategies``."""

from pathlib import Path

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

LONG = Path(__file__).parent / "workflow"


def pytest_collection_modifyitems(items):
    """The longest tests first: short ones even out who is done when."""
    items.sort(key=lambda item: LONG not in item.path.parents)
