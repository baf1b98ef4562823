"""What a run warns of before its first step, as its scene shows it."""

from __future__ import annotations

from riserstudy.model import rao
from riserstudy.model.steep_waves import breaking
from riserstudy.model.unusual_loads import unusual_loads
from riserstudy.records.warning import RunWarning, warning
from riserstudy.scene.followed import not_followed
from riserstudy.scene.limit_inputs import lacks_outputs
from riserstudy.scene.motion_records import uncovered
from riserstudy.scene.resolve import Resolved
from riserstudy.scene.sudden import sudden_wave
from riserstudy.scene.turning_centre import centre_above_the_well
from riserstudy.scene.wave_forces import joint_in_water, without_inertia
from riserstudy.scene.weight import doubts
from riserstudy.scene.without_time import without_time


def warnings_of(scene: Resolved) -> list[RunWarning]:
    """Warnings about a scene, whatever solves it."""
    return [
        *doubts(scene),
        *without_time(scene),
        *uncovered(scene),
        *without_inertia(scene),
        *joint_in_water(scene),
        *sudden_wave(scene),
        *breaking(scene),
        *centre_above_the_well(scene),
        *unusual_loads(scene),
        *rao.doubts(scene),
        *not_followed(scene),
        *_raised_stations(scene),
        *_few_outputs(scene),
    ]


def _few_outputs(scene: Resolved) -> list[RunWarning]:
    """A warning that histories see few phases of a periodic motion, and show another one."""
    output, shortest = scene.analysis.output, scene.shortest_regular_period
    if not scene.analysis.duration or output is None or shortest is None or not lacks_outputs(scene):
        return []
    text = (
        "analysis.output.interval: {interval:g} s is at least half of the shortest period, {period:g} s, "
        "so histories do not show this motion; choose less than {half:g} s"
    )
    values = {"interval": output.interval, "period": shortest, "half": 0.5 * shortest}
    return [warning("few_outputs_in_a_period", text, values)]


def _raised_stations(scene: Resolved) -> list[RunWarning]:
    """A warning that stations have other arclengths in the results, because a body turns with the end."""
    body, output = scene.bottom.body, scene.analysis.output
    if body is None or not body.reach or not (output and output.stations):
        return []
    text = (
        "bottom.body.centre_below: arclengths in results count from the body's centre of percussion, "
        "{reach:.4g} m below the riser's lower end; a station at 0 m has s = {reach:.4g} m"
    )
    return [warning("stations_above_a_body", text, {"reach": body.reach})]
