r"""The stack below a disconnected riser: a one-sided spring that the lower end can re-contact.

.. math:: f = k\,\max(0, z_0 - z), \qquad V = \tfrac12 k \max(0, z_0 - z)^2

References
----------
Elementary: Hooke's law, on one side.
"""

from __future__ import annotations

from typing import NamedTuple

from riserstudy.effects.registry import Called, register
from riserstudy.solve.jit import inner


class StackContact(NamedTuple):
    """The one-sided spring below the riser's lowest node."""

    elevation: float  # z_0, of the stack's connector (m)
    stiffness: float  # k (N/m)


@inner
def _below(contact, s):
    return max(contact.elevation - s.r[len(s.dim) - 1, 0], 0.0)


@inner
def force(contact, s):
    """Upward force below the connector, zero above it."""
    s.force[len(s.dim) - 1, 0] += contact.stiffness * _below(contact, s)
    return 0.0


@inner
def tangent(contact, s):
    """Stiffness while it touches."""
    d = len(s.dim)
    if _below(contact, s) > 0.0:
        s.k_node[0, d * d - 1] += contact.stiffness
    return 0.0


@inner
def energy(contact, s):
    """Work stored in the contact (J)."""
    return 0.5 * contact.stiffness * _below(contact, s) ** 2


register(
    StackContact,
    Called(
        "stack contact",
        "disconnect.stack",
        example={"disconnect": {"at": "0.5 s", "over": "0.2 s", "stack": {"stiffness": "1 MN/m"}}},
    ),
    device=force,
    tangent=tangent,
    potential=energy,
)
