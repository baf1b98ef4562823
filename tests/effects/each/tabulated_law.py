"""Tabulated law: a case, and the plain version."""

from __future__ import annotations

from scipy.interpolate import PPoly
from surroundings import Case, cylinders, pair

from riserstudy.effects.tabulated_law import TabulatedLaw
from riserstudy.model.tensioner_law import table_law
from riserstudy.scene.tensioners import TableRow


def tabulated(d: int) -> TabulatedLaw:
    table = [(-9.0, 6e5), (-4.0, 7e5), (-1.5, 7e5), (0.5, 7.4e5), (3.0, 9e5), (9.0, 9.3e5)]
    law = table_law([TableRow.model_construct(reach=x, force=f) for x, f in table])
    return TabulatedLaw(law.x, law.c, law.antiderivative().c, pair(1.0, 0.5))


def tabulated_law(record, s):
    return {"pull": record.working * PPoly(record.force, record.reach)(s.reach)}


CASES = {TabulatedLaw: Case(tabulated, lambda d: [cylinders(d)])}

PLAIN = {TabulatedLaw: [("law", tabulated_law)]}
