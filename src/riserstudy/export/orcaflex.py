"""Export of a scene as an OrcaFlex text model; everything without a counterpart is reported."""

from __future__ import annotations

from typing import NamedTuple

from riserstudy.export import pipes, surroundings, topside
from riserstudy.export.deck import Deck
from riserstudy.model.space_out import ring_at_mid_stroke
from riserstudy.scene.load import SceneFile
from riserstudy.scene.resolve import Resolved
from riserstudy.scene.units import GRAVITY


class Exported(NamedTuple):
    """The text of a deck, and the values of the scene that it lacks."""

    text: str
    left_out: list[str]


def write_deck(file: SceneFile) -> Exported:
    """Return the OrcaFlex text model of a scene.

    ``file``: scene of a riser that is held at its lower end. Raises InputError when the deck would
    describe another riser.

    Returns
    -------
    Exported
        Units are OrcaFlex's SI units: tonne, kN, m, s, kN m/deg.
    """
    scene = file.resolved()
    deck = Deck(file, scene)
    if scene.water is None:
        raise deck.refused(
            "water", "missing, but an OrcaFlex model always has water", "add water to the scene"
        )
    if scene.bottom.hold == "free" or scene.bottom.elevation is None:
        allowed = "write 'wellhead' or 'foot' to export the scene"
        found = f"a riser with 'hold: {scene.bottom.hold}' cannot be exported to OrcaFlex"
        raise deck.refused("bottom.hold", found, allowed)
    if scene.vessel:
        allowed = "replace vessel by platform, whose motion is prescribed"
        raise deck.refused("vessel", "a freely floating vessel cannot be exported to OrcaFlex", allowed)
    if scene.gravity not in (None, GRAVITY):
        deck.otherwise["gravity"] = (
            f"{scene.gravity:g} m/s^2 in the scene, {GRAVITY} m/s^2 in OrcaFlex: submerged weights "
            "are kept, weights of contents and weights in air change with gravity"
        )
    deck.objects |= {"General": surroundings.stages(deck)}
    deck.objects |= {"Environment": surroundings.environment(deck, scene.water)}
    surroundings.vessel(deck)
    clay = surroundings.soil(deck)
    pipes.line_types(deck)
    top, upper = topside.top(deck, _rest(scene))
    foot = ["Fixed", 0, 0, scene.bottom.elevation]
    deck.carried |= {"bottom.hold", "bottom.elevation", "bottom.rotation"}
    if scene.bottom.hold == "foot":
        held = "OrcaFlex holds the lower end in x and y, too; in the scene, only the soil does"
        deck.otherwise["bottom.hold"] = held
    pipes.lines(deck, top, upper, foot, pipes.stiffness(scene.bottom.rotation), clay)
    return Exported(deck.text(), deck.left_out())


def _rest(scene: Resolved) -> topside.Rest:
    """Return the elevations (m) of the riser's upper end, which is below a telescopic joint if it has one."""
    unstretched = (scene.bottom.elevation or 0.0) + sum(s.total_length for s in scene.riser)
    rig = scene.top.tensioners
    if rig is None or rig.mid_stroke == "riser unstretched":
        return topside.Rest(unstretched, unstretched)
    return topside.Rest(unstretched, ring_at_mid_stroke(scene))
