"""A value of a scene that changes nothing in its deck is named as left out, by itself or with its group."""

import copy
import re

import pytest
from drawn_decks import file_of, loaded
from exported_rigs import exported

from riserstudy.errors import InputError
from riserstudy.export.orcaflex import write_deck

NUMBER = re.compile(r"(-?[\d.]+(?:e[-+]?\d+)?)( .*)?")
PISTONS = {"mass": "6 t", "counted": "once"}


def numbers(tree, path=""):
    """Paths of the numbers of a scene, with the key by which each is set."""
    entries = tree.items() if isinstance(tree, dict) else enumerate(tree)
    for key, value in entries:
        at = f"{path}[{key}]" if isinstance(key, int) else f"{path}.{key}".lstrip(".")
        if isinstance(value, dict | list):
            yield from numbers(value, at)
        elif not isinstance(value, bool) and NUMBER.fullmatch(str(value)):
            yield at, tree, key


def whole(seed):
    """A scene with entries that a deck cannot have, below those that it has."""
    if seed % 2:
        scene = exported(seed, spatial=bool(seed % 4 == 1))
        scene["platform"]["response"]["beyond"] = "hold"
    else:
        scene = loaded(seed)
    joint, rig = (scene["top"].get(name) for name in ("telescopic_joint", "tensioners"))
    if joint:
        joint |= {"stop": {"stroke": "5 m", "collapse": "4 m", "stiffness": "3 MN/m"}}
        joint["mid_stroke"] = "riser in equilibrium"
    if rig and "arrangement" in rig and "gas" in rig and "linearised" not in rig:
        gas = rig.pop("gas")
        force = float(gas["area"].split()[0]) * float(gas["pressure"].split()[0])
        high = {name: gas[name] for name in ("area", "pressure", "volume")}
        low = {"area": gas["area"], "pressure": f"{0.02 * force / 0.08} Pa absolute", "volume": "2 m^3"}
        rig["two_chamber_gas"] = {"high": high, "low": low, "exponent": 1.1, "pistons": PISTONS}
        rig.pop("stroke", None)
    return scene


def bumped(value):
    number, unit = NUMBER.fullmatch(str(value)).groups()
    more = int(number) + 1 if isinstance(value, int) else 1.001 * float(number)
    return f"{more}{unit}" if unit else type(value)(more)


@pytest.mark.parametrize("seed", range(12))
def test_a_number_that_is_not_in_the_deck_is_named(seed):
    scene = whole(seed)
    first = write_deck(file_of(scene))
    named = {line.partition(": ")[0] for line in first.left_out}
    # a table of a current has an error of 0.1 %, which is named
    groups = [name for name in named if name == "current.profile"]
    groups += [line.partition(":")[0] for line in first.left_out if line.endswith(": not written")]
    silent = []
    for path, parent, key in list(numbers(scene)):
        before = copy.deepcopy(parent[key])
        parent[key] = bumped(before)
        try:
            changed = write_deck(file_of(scene)) != first  # the deck, or what is named
        except InputError:  # a length, for example, that no longer fits
            changed = True
        parent[key] = before
        bare = re.sub(r"\[\d+\]", "", path)
        grouped = any(bare == group or bare.startswith(f"{group}.") for group in groups)
        zero = float(NUMBER.fullmatch(str(before))[1]) == 0.0  # which stays zero
        if not (changed or zero or {path, bare} & named or grouped):
            silent.append(bare)
    assert sorted(set(silent)) == []


@pytest.mark.parametrize("seed", range(12))
@pytest.mark.parametrize("part", ["stop", "mid_stroke", "beyond", "pistons"])
def test_parts_below_what_a_deck_has_are_named(seed, part):
    scene = whole(seed)
    joint, rig = (scene["top"].get(name) or {} for name in ("telescopic_joint", "tensioners"))
    response = scene["platform"].get("response") or {}
    path = {
        "stop": joint and "top.telescopic_joint.stop",
        "mid_stroke": joint and "top.telescopic_joint.mid_stroke",
        "beyond": "beyond" in response and "platform.response.beyond",
        "pistons": "two_chamber_gas" in rig and "top.tensioners.two_chamber_gas.pistons",
    }[part]
    lines = write_deck(file_of(scene)).left_out
    assert not path or any(line.startswith(path) for line in lines)
