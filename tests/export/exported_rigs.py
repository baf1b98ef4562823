"""Seeded rigs in waves and turning currents that a deck can hold, as trees of a scene file."""

import math

import numpy as np
from random_rigs import rig, written

CLAY = {
    "strength_gradient": "0 N/m^3",
    "submerged_unit_weight": "8 kN/m^3",
    "strain_at_half_strength": 0.01,
    "depth_factor": 0.5,
    "straight_up_to": 0.1,
}


def exported(seed, spatial):
    """A rig on inclined cylinders below the water, on a platform in a regular wave, with how it is run.

    In the plane, wave and current are along x, either way. In space, the current turns with depth. Some rigs
    stand on a conductor in clay.
    """
    draw = np.random.default_rng((seed, spatial, 5))
    some = lambda share: draw.random() < share  # noqa: E731
    in_soil = some(0.35)
    tree = rig(seed, spatial=spatial, conductor=in_soil)
    ring = tree["top"]["elevation"] - tree["top"]["telescopic_joint"]["length"]
    tree["water"]["surface"] = max(0.0, ring + 1.0)
    if in_soil:
        tree["soil"] = {"mudline": tree["water"]["seabed"], "resistance": {}}
    count = tree["top"]["tensioners"]["count"]
    if spatial and some(0.4):
        tree["top"]["tensioners"]["failed"] = [int(draw.integers(count))]
    scene = written(tree)
    if in_soil:
        scene["soil"]["resistance"] = CLAY | {"strength_at_mudline": f"{draw.uniform(20, 80)} kPa"}
    if some(0.4):
        scene["top"]["tensioners"]["damping"] = f"{draw.uniform(1, 60)} kN*s/m"
    if some(0.5):
        scene["top"]["body"] = {"name": "ring", "mass": f"{draw.uniform(5, 40)} t"}
        scene["top"]["body"] |= {"displaced_volume": f"{draw.uniform(0.5, 3)} m^3"}
        scene["top"]["body"] |= {"drag_area": {"horizontal": "6 m^2", "vertical": "9 m^2"}}
    if some(0.3):
        scene["top"]["offset"] = f"{draw.uniform(-5, 5)} m"
    for section in scene["riser"]:
        if some(0.5):
            section["tangential_drag"] = {"coefficient": 0.02, "diameter": f"{draw.uniform(0.5, 1)} m"}
    if spatial:
        scene["current"] = turning(draw, -tree["water"]["seabed"])
    elif some(0.5):
        scene["current"]["heading"] = "180 deg"
    heading = int(draw.integers(360)) if spatial else int(draw.choice([0, 180]))
    motions = ["surge", "heave", "pitch"] + (["sway", "roll"] if spatial else [])
    with_headings = spatial or heading > 0 or some(0.5)
    return scene | waves(draw, scene["platform"], motions, heading, with_headings)


def turning(draw, depth):
    """A current of four points down to a depth (m), which turns by up to half a turn between two of them."""
    way = float(draw.uniform(0, 360))
    points = []
    for share, speed in ((0.0, 0.7), (0.1, 0.4), (0.5, 0.2), (1.1, 0.05)):
        direction = math.remainder(way, 360.0)
        point = {"depth": f"{share * depth} m", "speed": f"{speed} m/s", "direction": f"{direction} deg"}
        points.append(point)
        way += float(draw.uniform(-175, 175))
    return {"profile": points, "beyond": "hold"}


def waves(draw, platform, motions, heading, with_headings):
    """A wave that a platform follows, and a run of two periods; the build-up is as long as one period."""
    period = float(draw.integers(7, 15))
    wave = {"height": f"{draw.uniform(1, 5)} m", "period": f"{period} s", "ramp": f"{period} s"}
    wave |= {"above_mean_level": str(draw.choice(["constant", "stretched"]))}
    wave |= {"heading": f"{heading} deg"} if heading else {}
    rows = []
    for way in range(0, 360, 45) if with_headings else [None]:
        for at in (5, 8, 11, 16, 25):
            row = {"period": f"{at} s"} | ({} if way is None else {"heading": f"{way} deg"})
            for name in motions:
                unit = "deg/m" if name in ("pitch", "roll") else "m/m"
                row |= {name: f"{draw.uniform(0.05, 0.9)} {unit}"}
                row |= {f"{name}_phase": f"{draw.integers(-180, 180)} deg"}
            rows.append(row)
    response = {"operators": rows, "phases": str(draw.choice(["lag", "lead"])), "ramp": f"{period} s"}
    response |= {"headings": str(draw.choice(["towards", "from"]))} if with_headings else {}
    centre = {"elevation": f"{draw.uniform(-5, 10)} m"}
    step = f"{period / 30.0} s"
    run = {"duration": f"{2.0 * period} s", "step": step, "mesh": {"elements": 30}}
    return {
        "wave": wave,
        "platform": platform | {"response": response, "centre_of_rotation": centre},
        "analysis": run | {"output": {"interval": step}},
    }
