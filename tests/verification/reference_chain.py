"""A riser towed through a current that grows, as a chain of links: point masses, springs and SciPy's BDF.

In the plane of x (along the track) and z (up). Node k is k links below the joint. A link resists its
stretch, neighbours resist the angle between them, and the joint resists the angle of the uppermost link.
Water acts across the chain: drag, added mass, and, where a ramp accelerates it, twice the mass of the
displaced water times the acceleration (C_M = 2).
"""

from dataclasses import dataclass

import numpy as np
import scipy.sparse as sp
from scipy.integrate import solve_ivp
from scipy.interpolate import CubicSpline

DENSITY, GRAVITY, SEABED = 1025.0, 9.81, -1850.0


@dataclass(frozen=True)
class Chain:
    """The inputs of the evacuation, in SI."""

    links: int = 60
    length: float = 1800.0
    axial: float = 8.512685649e9
    bending: float = 2.752887192e8
    mass: float = 318.212
    weight: float = 2714.06
    diameter: float = 0.5334
    joint: float = 8800.0 * 180.0 / np.pi
    body: float = 140e3
    body_volume: float = 17.8
    ramp: float = 20.0

    def lowest(self, profile, top, until, accelerating):
        """Lower end x, z (m) at a time.

        Parameters
        ----------
        profile : speed of the current (m/s) at elevations.
        top : times, x and z of the upper end.
        accelerating : whether the ramp accelerates the water.
        """
        path = CubicSpline(top[0], np.stack(top[1:], axis=1))
        n, link = self.links, self.length / self.links
        share = np.full(n, link)
        share[-1] = 0.5 * link
        mass, weight = self.mass * share, self.weight * share
        mass[-1] += self.body
        weight[-1] += (self.body - DENSITY * self.body_volume) * GRAVITY
        added = 0.25 * np.pi * DENSITY * self.diameter**2 * share

        def rate(time, state):
            (x0, z0), (x, z, u, w) = path(time), state.reshape(4, n)
            dx, dz = np.diff(x, prepend=x0), np.diff(z, prepend=z0)
            fx, fz, ax, az = self._internal(dx, dz, link)
            fz = fz - weight
            flow = profile(z) * min(time / self.ramp, 1.0)
            relative = (flow - u) * az + w * ax  # across, whose direction is (az, -ax)
            coefficient = np.where(z > -150.0, 1.2, 0.7)
            across = 0.5 * DENSITY * self.diameter * coefficient * share * np.abs(relative) * relative
            if accelerating and time < self.ramp:
                across += 2.0 * added * profile(z) / self.ramp * az
            fx, fz = fx + across * az, fz - across * ax
            xx, xz, zz = mass + added * az**2, -added * ax * az, mass + added * ax**2
            det = xx * zz - xz**2
            return np.concatenate([u, w, (zz * fx - xz * fz) / det, (xx * fz - xz * fx) / det])

        hanging = np.cumsum(weight[::-1])[::-1]
        z = path(0.0)[1] - np.cumsum(link * (1.0 + hanging / self.axial))
        start = np.concatenate([np.full(n, path(0.0)[0]), z, np.zeros(2 * n)])
        near, own = sp.diags_array([1.0] * 5, offsets=range(-2, 3), shape=(n, n)), sp.eye_array(n)
        rows = [[None, None, own, None], [None, None, None, own], [near] * 4, [near] * 4]
        found = solve_ivp(
            rate, (0.0, until), start, "BDF", [until], rtol=1e-5, atol=1e-5, jac_sparsity=sp.block_array(rows)
        )
        assert found.success, found.message
        return found.y[n - 1, -1], found.y[2 * n - 1, -1]

    def _internal(self, dx, dz, link):
        """Forces (N) of links and of the angles between them on the nodes, and directions at the nodes."""
        size = np.hypot(dx, dz)
        tx, tz = dx / size, dz / size
        angle = np.arctan2(dx, -dz)
        moment = self.bending * np.diff(angle, append=angle[-1]) / link
        top = angle[0] / (1.0 / self.joint + 0.5 * link / self.bending)
        shear = (np.concatenate([[top], moment[:-1]]) - moment) / size
        stretch = self.axial * (size / link - 1.0)
        # on the lower end of each link: back along it, and against the growth of its angle
        px, pz = -stretch * tx + shear * tz, -stretch * tz - shear * tx
        fx, fz = px - np.append(px[1:], 0.0), pz - np.append(pz[1:], 0.0)
        ax, az = tx + np.append(tx[1:], tx[-1]), tz + np.append(tz[1:], tz[-1])
        norm = np.hypot(ax, az)
        return fx, fz, ax / norm, az / norm
