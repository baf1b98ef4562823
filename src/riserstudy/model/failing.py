"""Models in which a part of the tension is lost: failed cylinders, gas bottles that are shut off."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from riserstudy.effects.cylinder_damping import CylinderDamping
from riserstudy.effects.dead_load import DeadLoad
from riserstudy.effects.end_mass import EndMass
from riserstudy.effects.end_stop import EndStop
from riserstudy.effects.gas_spring import GasSpring
from riserstudy.effects.linear_spring import LinearSpring
from riserstudy.effects.recoil_valve import RecoilValve
from riserstudy.effects.tabulated_law import TabulatedLaw
from riserstudy.effects.two_chamber_gas import TwoChamberGas
from riserstudy.errors import SimulationError
from riserstudy.model.model import Effect, Model
from riserstudy.model.tensioners import PISTONS
from riserstudy.solve.evaluate import shape_of

#: fields of a tensioner record to set to zero for a failed cylinder
STRENGTH: dict[type, tuple[str, ...]] = {
    GasSpring: ("area",),
    TwoChamberGas: ("high_area", "low_area", "weight"),
    LinearSpring: ("tension", "stiffness"),
    TabulatedLaw: ("working",),
    CylinderDamping: ("damping",),
    EndStop: ("stiffness",),
    RecoilValve: ("resistance",),
}


def without_cylinders(model: Model, cylinders: list[int], pistons: float) -> Model:
    """The model in the same state, in which some cylinders exert no force.

    ``pistons``: share (1) of the pistons' mass that still moves with the ring.
    """

    def changed(effect: Effect) -> Effect:
        record: Any = effect.record
        if isinstance(record, EndMass) and effect.because == PISTONS:
            return effect._replace(record=record._replace(mass=pistons * record.mass))
        values = {name: getattr(record, name).copy() for name in STRENGTH.get(type(record), ())}
        for value in values.values():
            value[cylinders] = 0.0
        return effect._replace(record=record._replace(**values))

    return model.changed([changed(effect) for effect in model.effects], model.pairs)


def without_tension(model: Model, share: float) -> Model:
    """The model in the same state, without a share of its constant top tension."""

    def changed(effect: Effect) -> Effect:
        if not (isinstance(effect.record, DeadLoad) and effect.because == "top.tension"):
            return effect
        return effect._replace(record=effect.record._replace(load=(1.0 - share) * effect.record.load))

    return model.changed([changed(effect) for effect in model.effects], model.pairs)


def without_bottles(model: Model, volume: float) -> Model:
    """The model in the same state, with a volume (m3) of each cylinder's gas shut off.

    The pressure does not jump; from now on it follows the law of the remaining gas. Raises SimulationError
    when no gas would remain.
    """
    shape_of(model.programs, model.state)
    reach = model.s.reach.copy()

    def shut(area: Any, pressure: Any, full: Any, exponent: Any) -> tuple[Any, Any]:
        now = full - area * reach
        if np.any(now <= volume):
            raise SimulationError(
                f"disconnect.recoil_valve.isolation: volume is {volume:g} m^3, but a cylinder has only "
                f"{float(now.min()):.4g} m^3 of gas by then; give a smaller volume"
            )
        left = full - volume
        return pressure * (full / now) ** exponent * ((now - volume) / left) ** exponent, left

    def changed(record: Any) -> Any:
        if isinstance(record, GasSpring):
            pressure, left = shut(record.area, record.pressure, record.volume, record.exponent)
            return record._replace(pressure=pressure, volume=left)
        if isinstance(record, TwoChamberGas):
            pressure, left = shut(record.high_area, record.high_pressure, record.high_volume, record.exponent)
            return record._replace(high_pressure=pressure, high_volume=left)
        return record

    return _changed(model, changed)


def _changed(model: Model, change: Callable[[Any], Any]) -> Model:
    effects = [e._replace(record=change(e.record)) for e in model.effects]
    return model.changed(effects, model.pairs)
