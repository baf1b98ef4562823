"""Seeds of a test on drawn scenes: a few of them in `make test`, the others in `make test-slow`."""

import pytest


def seeds(number, few):
    """The seeds from 0 on, of which those after the first few are left to the slow tests."""
    return [*range(few), *(pytest.param(seed, marks=pytest.mark.slow) for seed in range(few, number))]
