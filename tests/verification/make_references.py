"""Recompute the stored references and print the evidence for their accuracy.

Run from this folder; takes about twenty minutes on one core. Each file under ``data`` holds float64
arrays and one text, ``about``. Names: s in m, time in s, x and z in m, moment in N m, top_force in
N (x and z components of the support's force on the rod); moment_min and moment_max are taken over
the times 0, 0.05, ..., 150 s.
"""

import sys
import time as clock
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).parent))

import reference_box
import reference_heave
from reference import DATA, Riser, static_current
from reference_rod import Rod, RodHistory

COMPARED = np.array([133.0, 233.0, 333.0, 433.0])
COARSE = np.linspace(0.0, 533.0, 41)
FINE = np.linspace(0.0, 533.0, 101)
STATIONS = np.concatenate([COMPARED, COARSE, FINE])
DURATION = 150.0


def rod(hold: bool, elements: int, step: float, method: str = "radau") -> RodHistory:
    """S2 or S2c by quintic elements."""
    model = Rod(Riser(), elements, hold, still=True)
    return timed(
        f"quintic elements {elements}, {method}, step {step} s",
        lambda: model.run(model.straight(), DURATION, step, round(0.05 / step), STATIONS, method),
    )


def box(hold: bool, intervals: int, step: float) -> RodHistory:
    """S2 or S2c by the box scheme."""
    return timed(
        f"collocation {intervals}, BDF2, step {step} s",
        lambda: reference_box.surge(STATIONS, intervals, step, hold, DURATION),
    )


def timed(name, run):
    """Run and say how long it took."""
    start = clock.perf_counter()
    result = run()
    print(f"  {name}: {clock.perf_counter() - start:.0f} s", flush=True)
    return result


def compare(name: str, a: RodHistory, b: RodHistory) -> None:
    """Largest differences, relative to the peaks of b; z and force also absolute."""
    x = np.abs(a.x - b.x).max() / np.abs(b.x[:, :4]).max()
    moment = np.abs(a.moment - b.moment).max() / np.abs(b.moment).max()
    z = np.abs(a.z - b.z).max()
    force = np.abs(a.top_force - b.top_force).max(axis=0)
    print(
        f"  {name}: x {x:.1e}, moment {moment:.1e}, z {z:.1e} m, support {force[0]:.2g} {force[1]:.2g} N",
        flush=True,
    )


def store(name: str, about: str, r: RodHistory) -> None:
    """Write what the tests need."""
    fine = r.moment[:, 45:]
    np.savez_compressed(
        DATA / f"{name}.npz",
        about=about,
        time=r.time,
        s=COMPARED,
        x=r.x[:, :4],
        z=r.z[:, :4],
        top_force=r.top_force,
        moment_time=r.time[::2],
        moment_s=COARSE,
        moment=r.moment[::2, 4:45],
        envelope_s=FINE,
        moment_min=fine.min(axis=0),
        moment_max=fine.max(axis=0),
    )


def surge(name: str, hold: bool) -> None:
    """S2 and S2c."""
    print(name)
    best = rod(hold, 80, 0.025)
    store(name, f"{name}: 80 quintic Hermite elements, Radau IIA, step 0.025 s", best)
    compare("step 0.05 s against 0.025 s", rod(hold, 80, 0.05), best)
    compare("40 elements against 80", rod(hold, 40, 0.025), best)
    compare("80 elements against 160", best, rod(hold, 160, 0.025))
    compare("Gauss of order 6 against Radau IIA", rod(hold, 80, 0.025, "gauss"), best)
    coarse, fine = box(hold, 400, 0.0125), box(hold, 400, 0.00625)
    compare("box scheme, step 0.0125 s", coarse, best)
    compare("box scheme, step 0.00625 s", fine, best)
    limit = RodHistory(*[(4.0 * f - c) / 3.0 for c, f in zip(coarse, fine, strict=True)])
    compare("box scheme, extrapolated", limit, best)


def heave() -> None:
    """S3."""
    print("S3")
    times = 0.05 * np.arange(2001)
    best = timed("characteristics", lambda: reference_heave.by_characteristics(times, tolerance=1e-12))
    other = timed("spectral elements", lambda: reference_heave.by_spectral_elements(times, tolerance=1e-9))
    for field in ("bottom", "top_tension", "bottom_tension"):
        a, b = getattr(other, field), getattr(best, field)
        peak = np.abs(b - b[0]).max()
        print(f"  {field}: difference {np.abs(a - b).max():.2g}, peak about static {peak:.6g}")
    np.savez_compressed(DATA / "S3.npz", about="S3: method of characteristics", **best._asdict())


def current() -> None:
    """S1: evidence only, it is cheap enough to be recomputed."""
    print("S1")
    s = np.linspace(0.0, 533.0, 101)
    best = static_current(s, tolerance=1e-10)
    loose = static_current(s, tolerance=1e-8)
    for elements in (40, 80, 160, 320):
        model = Rod(Riser(), elements, hold=False, still=False)
        x, z, moment = model.fields(model.statics(model.straight()), s)
        print(
            f"  quintic elements {elements}: x {np.abs(x - best.x).max() / best.x.max():.1e},"
            f" z {np.abs(z - best.z).max():.1e} m,"
            f" moment {np.abs(moment - best.moment).max() / np.abs(best.moment).max():.1e}"
        )
    for field in ("x", "z", "theta", "tension", "moment"):
        a, b = getattr(loose, field), getattr(best, field)
        print(f"  tolerance 1e-8 against 1e-10, {field}: {np.abs(a - b).max() / np.abs(b).max():.1e}")


if __name__ == "__main__":
    wanted = sys.argv[1:] or ["S1", "S3", "S2c", "S2"]
    for scene in wanted:
        {
            "S1": current,
            "S3": heave,
            "S2c": lambda: surge("S2c", hold=True),
            "S2": lambda: surge("S2", hold=False),
        }[scene]()
