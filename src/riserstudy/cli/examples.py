"""An example of every command, for its help text."""

from __future__ import annotations

EXAMPLES = {
    "run": "riserstudy run riser.yaml -o riser.nc --accuracy 1%",
    "check": "riserstudy check riser.yaml --set platform.position.surge='20 m'",
    "rerun": "riserstudy rerun results/bench/s2.nc",
    "modes": "riserstudy modes riser.yaml --count 5",
    "tune": "riserstudy tune config/studies/drilling.yaml --accuracy 1% --write",
    "plot": "riserstudy plot riser.nc -o ranges.png --of bending_moment",
    "table": "riserstudy table riser.yaml -o stack_up.csv --kind stack-up",
    "statistics": "riserstudy statistics sea.nc -o extremes.csv --start '200 s' --exposure '3 h'",
    "compare": "riserstudy compare riser.nc measured.csv -o both.png",
    "draw": "riserstudy draw riser.yaml -o riser.png",
    "cost": "riserstudy cost riser.yaml",
    "effects": "riserstudy effects riser.yaml --times",
    "advise": "riserstudy advise riser.yaml",
    "tension": (
        "riserstudy tension riser.yaml --units 6 --failed 1 --tension-ratio 0.95 "
        "--weight 1.05 --buoyancy 0.96"
    ),
    "operability": "riserstudy operability riser.yaml --reach '100 m' --allowance lfj_angle='0.5 deg'",
    "envelope": "riserstudy envelope riser.yaml --reach '100 m' --current '0.5 m/s' --sea '4 m, 10 s'",
    "viv": "riserstudy viv riser.yaml --lift 0.8",
    "watch-circles": "riserstudy watch-circles drift.yaml --disconnect '60 s' --prepare '120 s'",
    "recoil": "riserstudy recoil disconnect.yaml --csv recoil.csv",
    "seas": "riserstudy seas hindcast.csv -o seas.nc",
    "downtime": "riserstudy downtime seas.nc --limit 'hs <= 2.5 m' --window '24 h'",
    "fatigue": "riserstudy fatigue results/mine/seas.nc --scatter scatter.csv --plot fatigue.png",
    "import": "riserstudy import deck.yml -o riser.yaml",
    "export": "riserstudy export riser.yaml -o deck.yml",
    "new": "riserstudy new my_study",
    "schema": "riserstudy schema scene > scene.schema.json",
    "results": "riserstudy results liu2020/roll_runs --sort -largest_bending_moment",
    "sql": "riserstudy sql 'select paper, id, verdict from numbers_and_claims' --csv verdicts.csv",
    "verify": "riserstudy verify",
    "prune": "riserstudy prune",
    "crate": "riserstudy crate study.zip",
    "diff": "riserstudy diff results_before results",
}
