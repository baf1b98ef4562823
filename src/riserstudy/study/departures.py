"""Checks of a scene for runs in seas: no event, wave or motion of its own, limits with all inputs."""

from __future__ import annotations

from riserstudy.dataset.limits import label
from riserstudy.errors import InputError
from riserstudy.scene.forcing import TILTS, TRANSLATIONS, Harmonic
from riserstudy.scene.limit_inputs import lacks, lacks_outputs
from riserstudy.scene.load import SceneFile
from riserstudy.scene.resolve import Resolved
from riserstudy.scene.sea import Storm


def check_stays(file: SceneFile) -> None:
    """Check that runs of a scene in a sea show whether each limit is met in this sea.

    Raises InputError when a limit lacks inputs, a vessel drifts, or an event or a motion away changes the
    state of the riser during a run. Raises it, too, when a wave or a motion is equal in all seas.
    """
    scene = file.resolved()
    refuse_departures(file.source, scene)
    refuse_unchanged(file.source, scene)
    refuse_drifts(file.source, scene)
    for k, limit in enumerate(scene.limits or []):
        few = lacks_outputs(scene) if limit.side == "mean" else ""
        if missing := lacks(scene, limit) or [few] * bool(few):
            found = f"the limit on {label(limit)} cannot be evaluated without further inputs"
            raise InputError(file.source, f"limits[{k}]", found, f"give {', '.join(missing)}")


def departure(source: str, field: str, what: str, remedy: str) -> InputError:
    """The error for a part of a scene that changes its state during the runs in a sea."""
    return InputError(source, field, f"{what} during the runs in a sea", remedy)


def refuse_departures(source: str, scene: Resolved) -> None:
    """Refuse a scene with an event or a motion away, whose effect would count as that of the sea.

    Raises InputError when the scene has one of them.
    """
    if scene.platform and scene.platform.cruise:
        raise departure(source, "platform.cruise", "moves the platform away", "remove it")
    if scene.disconnect:
        raise departure(source, "disconnect", "disconnects the riser", "remove it")
    if scene.top.tension_loss:
        raise departure(source, "top.tension_loss", "changes the tension", "remove it")
    if scene.top.tensioners and scene.top.tensioners.failing:
        remedy = "write `failed` instead, for cylinders that have failed before the run"
        raise departure(source, "top.tensioners.failing", "changes the tension", remedy)


def refuse_unchanged(source: str, scene: Resolved) -> None:
    """Refuse a scene with a regular wave, or with a platform that moves without following the sea.

    They would be equal in all seas, and the highest sea would load the riser as the lowest one does. Raises
    InputError when the scene has one of them.
    """
    for path, wave in scene.waves.items():
        if not isinstance(wave, Storm):
            found = "this regular wave would be equal in all sea states"
            raise InputError(source, path, found, "remove it, or replace it by an irregular sea")
    response = scene.platform and scene.platform.response
    if not response and (names := prescribed_motions(scene)):
        found = "the platform would move equally in all sea states"
        remedy = "replace it by `platform.response`, with which the platform follows the sea"
        raise InputError(source, f"platform.{names[0]}", found, remedy)


def prescribed_motions(scene: Resolved) -> list[str]:
    """Names of the platform's motions that are prescribed over time, and do not follow a sea."""
    found = []
    for name in (*TRANSLATIONS, *TILTS) if scene.platform else ():
        motion = getattr(scene.platform, name)
        each = motion if isinstance(motion, list) else [motion]
        if any(one and not (isinstance(one, Harmonic) and one.amplitude == 0.0) for one in each):
            found.append(name)
    return found


def refuse_drifts(source: str, scene: Resolved) -> None:
    """Refuse a scene whose vessel drifts, because no thrust returns it to its place.

    Raises InputError when it does.
    """
    vessel = scene.vessel
    if vessel is None:
        return
    thrusters = vessel.thrusters
    gains = [thrusters.gain if thrusters else 0.0]
    if vessel.sway and scene.spatial:
        gains.append(thrusters.sway.gain if thrusters and thrusters.sway else 0.0)
    if not all(gain > 0.0 for gain in gains):
        remedy = "give it `thrusters` with a gain, or replace it by `platform` and `top.x: platform`"
        raise departure(source, "vessel", "the vessel drifts away", remedy)
