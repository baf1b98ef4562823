"""A vessel adrift below a thread that does not hold it back."""

from riserstudy.design.drift import Hull

HULL = Hull(9e7, 599625.0)  # mass with added mass (kg), drag (N s2/m2)


def adrift(force=1e6, current=0.0, **parts):
    """The scene of that hull with a force (N) on it in a uniform current (m/s), and further parts."""
    tree = {
        "title": "adrift",
        "gravity": "9.81 m/s^2",
        "water": {"density": "1025 kg/m^3", "surface": "1000 m", "seabed": "0 m"},
        "riser": [
            {
                "name": "thread",
                "length": "1000 m",
                "axial_stiffness": "100 N",
                "mass": "0.001 kg/m",
                "submerged_weight": "0 N/m",
            }
        ],
        "bottom": {"hold": "wellhead", "elevation": "0 m"},
        "top": {"x": "vessel", "z": "held", "elevation": "1001 m"},
        "vessel": {
            "mass": "6e7 kg",
            "added_mass": "3e7 kg",
            "hull_drag": "599625 N*s^2/m^2",
            "wave_drift": {"force": f"{force} N", "heading": "0 deg"},
        },
        "analysis": {
            "duration": "400 s",
            "mesh": {"elements": 10},
            "step": "0.25 s",
            "output": {"interval": "1 s"},
        },
        **parts,
    }
    if current:
        tree["current"] = {"profile": {"shape": "uniform", "surface_speed": f"{current} m/s"}}
    return tree
