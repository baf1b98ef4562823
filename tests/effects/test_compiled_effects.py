"""Effects compiled and interpreted give the same."""

import importlib
import pkgutil

import numpy as np
import pytest
from derivatives import relative
from numba.core.registry import CPUDispatcher
from rig import PAIRS, Rig, copied

import riserstudy.effects
from riserstudy.effects.registry import ROLES
from riserstudy.solve import blocktri, spread
from riserstudy.solve.evaluate import one_call
from riserstudy.solve.program import assemble

modules = [
    importlib.import_module(f"riserstudy.effects.{m.name}")
    for m in pkgutil.iter_modules(riserstudy.effects.__path__)
]


@pytest.fixture
def uncompile(monkeypatch):
    """Replace compiled helpers by the Python functions they were made from, once all is compiled."""

    def replace():
        for module in [*modules, blocktri, spread]:
            for key, value in list(vars(module).items()):
                if isinstance(value, CPUDispatcher):
                    monkeypatch.setattr(module, key, value.py_func)

    return replace


# memory of other arrays, which a copy of the state does not share; those are compared themselves
MEMORY = {"loads", "seas", "lumps", "slopes"}
PIECES = [(kind, d, role) for kind, d in PAIRS for role in ROLES[kind]]


@pytest.mark.long
@pytest.mark.parametrize("piece", PIECES, ids=lambda p: f"{p[0].__name__}-{p[1]}d-{p[2]}")
def test_compiled_and_interpreted_effects_agree(piece, uncompile):
    kind, d, role = piece
    rig = Rig(kind, d)
    rig.s.rate[:] = 3.0, 10.0
    rig.evaluate()
    state, record = copied(rig.s), copied(rig.record)
    function = ROLES[kind][role]
    frozen = rig.frozen_record()
    compiled = one_call(assemble([(function, frozen)], rig.model.state), rig.model.state)
    uncompile()
    interpreted = function.py_func(record, state)
    assert compiled == pytest.approx(interpreted, rel=1e-10)
    for field in set(state._fields) - MEMORY:
        expected = np.asarray(getattr(state, field))
        if expected.size:
            assert relative(getattr(rig.s, field), expected) < 1e-10, field
