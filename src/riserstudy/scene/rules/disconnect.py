"""Events of a run: a disconnect with its valves, and sudden losses of tension."""

from __future__ import annotations

from typing import TYPE_CHECKING

from riserstudy.inputs.misfit import Misfit
from riserstudy.scene.alike import alike
from riserstudy.scene.disconnect import too_late
from riserstudy.scene.tensioners import fault_of_numbers

if TYPE_CHECKING:
    from collections.abc import Iterator

    from riserstudy.scene.disconnect import RecoilValve
    from riserstudy.scene.parts import Parts


def disconnect(scene: Parts) -> Iterator[Misfit]:
    """A disconnect requires a riser that is held at its wellhead; valves require the tension they act on."""
    release = scene.disconnect
    if release is None:
        return
    if scene.bottom.hold != "wellhead":
        found = f"a riser with 'bottom.hold: {scene.bottom.hold}' has no wellhead to disconnect from"
        remedy = "write 'bottom.hold: wellhead', or remove disconnect"
        yield Misfit("disconnect", found, remedy, ("bottom.hold",))
    if scene.bottom.body and scene.bottom.body.reach:
        found, remedy = "does not work with bottom.body.centre_below", "remove centre_below"
        yield Misfit("disconnect", found, remedy, ("bottom.body.centre_below",))
    if release.valve and (scene.top.tension is None or scene.top.tension_loss):
        found = "requires a constant top.tension without tension_loss"
        remedy = "give top.tension, and remove top.tension_loss"
        yield Misfit("disconnect.valve", found, remedy, ("top.tension", "top.tension_loss"))
    if release.valve:
        yield from _shared_pull(scene)
    if release.recoil_valve:
        yield from _throttled(scene, release.recoil_valve)
    if release.drain:
        yield from _drains(scene)


def _shared_pull(scene: Parts) -> Iterator[Misfit]:
    """Valves that reduce the tension to a share of the hanging weight require that nothing else pulls."""
    top, joint = scene.top, scene.top.telescopic_joint
    others = {"top.tensioners": top.tensioners, "top.telescopic_joint.tension": joint and joint.tension}
    for path, pull in others.items():
        if pull is not None:
            found = f"changes top.tension only, but {path} also pulls"
            remedy = f"give all tension as top.tension, and remove {path}"
            yield Misfit("disconnect.valve", found, remedy, ("top.tension", path))


def _throttled(scene: Parts, valve: RecoilValve) -> Iterator[Misfit]:
    """A recoil valve requires gas tensioners; bottles that are shut off hold less than a cylinder's gas."""
    rig, path, also = scene.top.tensioners, "disconnect.recoil_valve", ("top.tensioners",)
    gas = rig.pulling if rig else None
    if rig is None or gas is None or rig.linearised:
        found = "requires top.tensioners with gas or two_chamber_gas that is not linearised"
        yield Misfit(path, found, "give such tensioners, or remove recoil_valve", also)
        return
    if fault := fault_of_numbers(valve.failed or [], rig.count):
        yield Misfit(f"{path}.failed", *fault, also)
    if valve.isolation and not valve.isolation.volume < gas.volume:
        found = f"{valve.isolation.volume:g} m^3 is not less than the gas volume of a cylinder"
        yield Misfit(f"{path}.isolation.volume", found, f"give less than {gas.volume:g} m^3", also)


def _drains(scene: Parts) -> Iterator[Misfit]:
    """Draining contents must be one fluid from the lower end upwards, in a sea of known level."""
    path, filled = "disconnect.drain", [s for s in scene.riser if s.contents]
    if not filled or any(s.contents for s in scene.riser[len(filled) :]):
        found = "requires contents from the lowest section upwards, without a gap"
        remedy = "give contents to these sections, or remove drain"
        yield Misfit(path, found, remedy, ("riser",))
        return
    inside = [s.contents for s in filled if s.contents]
    same = alike(c.density for c in inside) and alike(c.level for c in inside)
    if not same:
        found = "contents differ between sections"
        remedy = "give the same contents to all sections with contents"
        yield Misfit(path, found, remedy, ("riser",))
    if scene.water is None or scene.water.surface is None:
        found = "requires the elevation of the water surface, for the pressure of the sea at the lower end"
        remedy = "add water.surface"
        yield Misfit(path, found, remedy, ("water.surface",))


def events(scene: Parts) -> Iterator[Misfit]:
    """Events must be before the end of the run, and require an integrator that can stop at them."""
    a, times = scene.analysis, _times(scene)
    if a.duration is None:
        found = "an event requires a dynamic run"
        remedy = "add analysis.duration and output, or remove the event"
        for path in times:
            yield Misfit(path.rpartition(".")[0], found, remedy, ("analysis.duration",))
    else:
        yield from too_late(times, a.duration)
    if not scene.events:
        return
    path = next(path for path, there in _sudden(scene).items() if there)
    if a.method == "explicit" or a.solver:
        found, also = (
            "requires an implicit method and the lumped-mass solver",
            ("analysis.method", "analysis.solver"),
        )
        yield Misfit(path, found, "remove analysis.method and analysis.solver", also)
    if scene.vessel and scene.vessel.coupling:
        found = "does not work with vessel.coupling"
        yield Misfit(path, found, "remove vessel.coupling", ("vessel.coupling",))


def _times(scene: Parts) -> dict[str, float]:
    """Times from which on events act (s), by their paths in the scene."""
    loss, rig = scene.top.tension_loss, scene.top.tensioners
    times = dict(scene.disconnect.times) if scene.disconnect else {}
    if loss:
        times["top.tension_loss.at"] = loss.at
    if rig and rig.failing:
        times["top.tensioners.failing.at"] = rig.failing.at
    return times


def _sudden(scene: Parts) -> dict[str, object]:
    """Parts of the scene that cause an event, by path; false where the scene does not have them."""
    loss, rig = scene.top.tension_loss, scene.top.tensioners
    return {
        "disconnect": scene.disconnect,
        "top.tension_loss": loss and loss.over is None,
        "top.tensioners.failing": rig and rig.failing,
    }
