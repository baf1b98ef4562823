"""The generic riser under a platform that a sea moves, in short runs on a coarse mesh, for several tests."""

import json

RISER = "config/scenes/design/riser.yaml"
ALONG = {"surge": "0.4 m/m", "surge_phase": "90 deg", "heave": "0.3 m/m", "heave_phase": "0 deg"}


def in_a_sea(limits, periods, components, duration):
    """What puts it there, by path of the scene.

    Parameters
    ----------
    periods : of the waves for which the platform's operators are given (s).
    """
    operators = [{"period": f"{period} s", **ALONG} for period in periods]
    wave = {"significant_height": "3 m", "peak_period": "10 s", "peak_enhancement": 2}
    wave |= {"components": components, "seed": 1}
    response = {"operators": operators, "phases": "lead", "wave": wave, "ramp": "20 s"}
    mesh = {"mesh": {"elements": 40}, "step": "0.5 s"}
    return {
        "limits": limits,
        "top.x": "platform",
        "top.z": "platform",
        "platform": {"centre_of_rotation": {"elevation": "1500 m"}, "response": response},
        "analysis": {"duration": duration, "output": {"interval": "1 s"}, **mesh},
    }


def words(values):
    """Values by path as options of a command."""
    return [word for path, v in values.items() for word in ("--set", f"{path}={json.dumps(v)}")]
