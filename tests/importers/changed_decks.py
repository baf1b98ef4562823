"""A deck of another program, changed in its parts, and the scene that it becomes."""

import math
import sys
import warnings
from pathlib import Path

from ruamel.yaml import YAML
from ruamel.yaml.error import MantissaNoDotYAML1_1Warning

from riserstudy import load_scene
from riserstudy.cli import main
from riserstudy.importers.orcaflex.sea import Sea

DECK = Path(__file__).parent / "decks/riser.yml"
GRAVITY = 9.80665
CALM = Sea(0.0, -500.0, 1025.0, GRAVITY)


#: headers of tables, as decks have them
ENDS = (
    "Connection, ConnectionX, ConnectionY, ConnectionZ, ConnectionAzimuth, ConnectionDeclination, "
    "ConnectionGamma, ConnectionReleaseStage, ConnectionzRelativeTo"
)
BENDING = "ConnectionxBendingStiffness, ConnectionyBendingStiffness"
SECTIONS = "LineType, Length, TargetSegmentLength"
CURRENT = "CurrentDepth, CurrentFactor, CurrentRotation"
LINKED = "Connection, ConnectionX, ConnectionY, ConnectionZ, ConnectionzRelativeTo"
WINCHED = "Connection, ConnectionX, ConnectionY, ConnectionZ"
SPRING = "SpringLength, SpringTension"
STAGES = "StageMode, StageValue"
FREEDOMS = "DOFFree, DOFInitialValue"


def changed(folder, change=lambda deck: None):
    """The deck with a change, as a file of its own."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", MantissaNoDotYAML1_1Warning)  # decks write 250e3
        deck = YAML().load(DECK)
    change(deck)
    target = folder / "deck.yml"
    writer = YAML()
    writer.version = (1, 1)
    writer.representer.ignore_aliases = lambda data: True
    with target.open("w") as file:
        writer.dump(deck, file)
    return target


def loaded(folder, change=lambda deck: None):
    """Its scene, by the command."""
    target = folder / "scene.yaml"
    sys.argv = ["riserstudy", "import", str(changed(folder, change)), "-o", str(target), "--force"]
    main()
    return load_scene(target).resolved()


def pulled(deck):
    """The upper end free, on four springs to a circle of 5 m, 20 m above it, that each pull 800 kN."""
    deck["Environment"]["WaveTrains"][0]["WaveHeight"] = 0
    del deck["Vessels"], deck["General"]["StageDuration"], deck["Environment"]["RefCurrentSpeed"]
    line = deck["Lines"][0]
    line[ENDS][0] = ["Free", 0, 0, 9.4, 0, 0, 0, None, None]
    line[BENDING][0] = [0, None]
    reach = math.hypot(5.0, 20.0)
    deck["Links"] = [
        {
            "Name": f"T{k}", "LinkType": "Spring/Damper", "LinearSpring": True,
            "UnstretchedLength": reach - 16.0, "Stiffness": 50.0,
            LINKED: [["Fixed", x, y, 29.4, None], ["Riser", 0, 0, 0, "End A"]],
        }
        for k, (x, y) in enumerate(((5, 0), (0, 5), (-5, 0), (0, -5)))
    ]  # fmt: skip


def sea(deck, **changes):
    """A JONSWAP sea in the place of the wave."""
    train = deck["Environment"]["WaveTrains"][0]
    del train["WaveHeight"], train["WavePeriod"]
    train.update({
        "WaveType": "JONSWAP", "WaveJONSWAPParameters": "Partially specified", "WaveHs": 5.0,
        "WaveTp": 11.0, "WaveGamma": 2.0, "WaveNumberOfComponents": 60, "WaveSeed": 12345, **changes,
    })  # fmt: skip
    for key in [key for key, value in train.items() if value is None]:
        del train[key]


REACH = math.hypot(5.0 - 1.0, 20.0)  # of each tensioner, the riser unstretched


def rig(deck, links=0, winches=0):
    """A ring of 15 t on four tensioners to the vessel, by a table if nothing is asked, under a joint."""
    line = deck["Lines"][0]
    line[ENDS][0] = ["Ring", 0, 0, 0, 0, 180, 0]
    line[BENDING][0] = ["Infinity", None]
    deck["6DBuoys"] = [{
        "Name": "Ring", "BuoyType": "Lumped buoy", "Connection": "Free", "Mass": 15.0, "Volume": 2.0,
        "InitialPosition": [0, 0, 9.4], "MomentsOfInertia": [1, 1, 1],
    }]  # fmt: skip
    deck["LineTypes"].append({
        "Name": "Barrel", "Category": "General", "OD": 0.5, "ID": 0.4, "EIx": 600e3, "MassPerUnitLength": 0.5,
    })  # fmt: skip
    deck["Lines"].append({
        "Name": "InnerBarrel", "TopEnd": "End A",
        ENDS: [["Rig", 0, 0, 28, 0, 180, 0], ["Slip", 0, 0, 0, 0, 180, 0]],
        BENDING: [[10, None], ["Infinity", None]],
        SECTIONS: [["Barrel", 18.6, 2]],
    })  # fmt: skip
    free = [[False], [False], [True, -1.0], [False], [False], [False]]
    deck["Constraints"] = [{
        "Name": "Slip", "InFrameConnection": "Ring", "ConstraintType": "Calculated DOFs", FREEDOMS: free,
        "TranslationalStiffness": 0,
    }]  # fmt: skip
    places = [(1, 0), (0, 1), (-1, 0), (0, -1)]
    ends = [[["Rig", 5 * x, 5 * y, 29.4], ["Ring", x, y, 0]] for x, y in places]
    table = [[REACH - 5.0, 700.0], [REACH, 800.0], [REACH + 5.0, 1000.0]]
    straight = {"LinearSpring": "Yes", "UnstretchedLength": REACH - 16.0, "Stiffness": 50.0}
    for k, end in enumerate(ends):
        if winches:
            deck.setdefault("Winches", []).append({
                "Name": f"T{k}", "WinchType": "Simple", WINCHED: end, "Stiffness": 1e5, "Damping": 0,
                "WinchControlType": "By stage", STAGES: [["Specified tension", 800.0]] * 3,
            })  # fmt: skip
            continue
        law = straight if links else {"LinearSpring": "No", SPRING: table}
        deck.setdefault("Links", []).append(
            {"Name": f"T{k}", "LinkType": "Spring/damper", WINCHED: end, **law}
        )


def at_rest(deck):
    """Without waves and current."""
    deck["Environment"]["WaveTrains"][0]["WaveHeight"] = 0
    deck["General"]["StageDuration"] = None
    del deck["Environment"]["RefCurrentSpeed"]


def flexing(deck):
    """The lower end clamped to a constraint on the seabed that turns about x and y."""
    line = deck["Lines"][0]
    line[ENDS][1] = ["Flex", 0, 0, 0, 0, 0, 0]
    line[BENDING][1] = ["Infinity", None]
    free = [[False], [False], [False], [True, 0], [True, 0], [False]]
    deck["Constraints"] = [{
        "Name": "Flex", "InFrameConnection": "Anchored", "InFrameInitialPosition": [0, 0, 5],
        "ConstraintType": "Calculated DOFs", FREEDOMS: free, "StiffnessAndDampingMethod": "Coefficients",
        "RotationalStiffness": 120.0,
    }]  # fmt: skip


def _file(folder, change):
    loaded(folder, change)
    return load_scene(folder / "scene.yaml")


def in_soil(deck, **other):
    """The lowest pipe reaches 54.4 m into clay."""
    clay = {
        "DepthBelowSeabedFrom": 0, "ModelType": "API RP 2A soft clay", "EffectiveUnitSoilDensity": 0.6,
        "UndrainedShearStrength": 8, "J": 0.5, "Epsilonc": 2,
    }  # fmt: skip
    deck["P-yModels"] = [{"Name": "Clay", "PyCurves": [clay | other]}]
    line = deck["Lines"][0]
    line["PyModel"] = "Clay"
    line[ENDS][1][3] = -54.4
    line[BENDING][1] = [0, None]
    line[SECTIONS].append(["Pipe", 59.4, 5])


def later(deck):
    """Line types as later versions write them."""
    joint, pipe = deck["LineTypes"]
    for name in ("EIx", "EIy", "Cdx", "Cdy", "Cax", "Cay"):
        joint.pop(name, None), pipe.pop(name, None)
    joint.update(EI=[250e3, None], Cd=[1.1, None, 0.008], Ca=[1, None, 0])
    pipe.update(Cdn=1.2, Can=1)
