"""Hostile input by kind and seed: files in a folder and the command that meets them.

A kind is a function (rng, folder) that writes files and returns the arguments of ``riserstudy``, or a
function to call where no command reads such files.
"""

import random
import shutil
from functools import cache
from pathlib import Path

from ruamel.yaml import YAML
from spoil import VALUES, spoilt, torn

from riserstudy.jobs.workplan import Workplan

CONFIG = Path(__file__).parents[2] / "config"
SHORT = {"duration": "2 s", "output": {"interval": "0.5 s"}, "mesh": {"elements": 8}, "step": "0.1 s"}
#: refused for its output, once all of its input is found good
NOWHERE = "absent/out.nc"
OUT = "out.nc"
PATIENCE = ("0.001", "0.3", "20", "0.1 min", "0", "-1 s", "soon", "1e400", "3 m", "nan")
TABLES = {
    "current.profile": "depth (m), speed (m/s)\n0, 1.2\n133, 1\n333, 0.5\n533, 0\n",
    "platform.heave": "time (s), value (m)\n" + "".join(f"{t}, {t % 3 - 1}\n" for t in range(12)),
    "platform.response": "frequency (Hz), heading (deg), surge (m/m), surge_phase (deg)\n"
    "0.03, 180, 1, 90\n0.1, 180, 0.5, 80\n0.2, 180, 0.1, 90\n",
}
WORDS = (
    *(Path(__file__).with_name("words.txt").read_text("unicode_escape").splitlines()),
    "a" * 5000,
    "title=" + "[" * 200,
)


def scene(rng, folder):
    """A scene of the repository, spoilt; one in five, spoilt in one place, is run in short."""
    run = rng.random() < 0.2
    tree = dict(rng.choice(scenes()))
    if run and "duration" in tree["analysis"]:
        tree["analysis"] = {**tree["analysis"], **SHORT}
        tree["analysis"].pop("accuracy", None)
    (folder / "case.yaml").write_bytes(spoilt(tree, scenes(), rng, 1 if run else 3))
    (folder / "a.csv").write_text(rng.choice(list(TABLES.values())))
    words = ["run", "case.yaml", "-o", OUT if run else NOWHERE]
    if run and rng.random() < 0.5:
        words += ["--patience", rng.choice(PATIENCE)]
    return words


def table(rng, folder):
    """A good scene with a spoilt table; one in ten is run."""
    run = rng.random() < 0.1
    place, text = rng.choice(list(TABLES.items()))
    shutil.copy(CONFIG / "scenes/bench/s2.yaml", folder / "case.yaml")
    (folder / "a.csv").write_bytes(torn_table(text, rng))
    value = "{file: a.csv}"
    settings = {"water": "{density: 1025 kg/m^3, surface: 533 m, seabed: 0 m}", "gravity": "9.81 m/s^2"}
    if place == "platform.response":
        wave = "{height: 2 m, period: 9 s}"
        value = f"{{operators: {value}, phases: lead, headings: from, wave: {wave}}}"
    settings |= {place: value, "analysis.duration": "2 s", "analysis.output": "{interval: 0.5 s}"}
    words = [word for path, text in settings.items() for word in ("--set", f"{path}={text}")]
    return ["run", "case.yaml", "-o", OUT if run else NOWHERE, *words]


def torn_table(text, rng):
    """A table with a cell or its bytes changed."""
    if rng.random() < 0.5:
        return torn(text.encode(), rng)
    lines = [line.split(",") for line in text.splitlines()]
    for _ in range(rng.randint(1, 3)):
        line = rng.choice(lines)
        line[rng.randrange(len(line))] = rng.choice(VALUES)
    rng.choice([lambda: None, lambda: lines.append(rng.choice(lines)), lambda: lines[1:].clear()])()
    return "\n".join(",".join(line) for line in lines).encode()


def command(rng, folder):
    """Words of the command line in any order, beside a good scene."""
    shutil.copy(CONFIG / "scenes/bench/s4b.yaml", folder / "case.yaml")
    words = [rng.choice(WORDS) for _ in range(rng.randint(0, 6))]
    if rng.random() < 0.6:
        start = rng.choice([["run", "case.yaml", "-o", OUT], ["effects", "case.yaml"], ["results"]])
        words = [*start, *words]
    return words


def study(rng, folder):
    """A study file of the repository, spoilt, with few of its studies, so that each is read in short."""
    paper, tree = rng.choice(studies())
    kept = rng.sample(list(tree["studies"]), min(2, len(tree["studies"])))
    tree = {
        **tree,
        "studies": {name: tree["studies"][name] for name in kept},
        "derived": {k: v for k, v in tree.get("derived", {}).items() if set(v) <= set(kept)},
        "figures": {k: v for k, v in tree["figures"].items() if set(v["reads"]) <= set(kept)},
    }
    config = folder / "config"
    (config / "studies").mkdir(parents=True)
    shutil.copytree(CONFIG / "scenes", config / "scenes")
    shutil.copytree(CONFIG / "platforms", config / "platforms")
    shutil.copy(CONFIG / "config.yaml", config)
    donors = [other for _, other in studies()]
    (config / f"studies/{paper}.yaml").write_bytes(spoilt(tree, donors, rng))

    def plan():
        settings = {"papers": [paper], "tier": "preview"}
        for planned in Workplan.read(config, settings).studies:
            planned.digest  # noqa: B018  what Snakemake asks of each study

    return plan


KINDS = {"scene": scene, "study": study, "table": table, "command": command}


def case(kind, seed, folder):
    """Write the files of a case; the words of its command, or what to call."""
    return KINDS[kind](random.Random(f"{kind} {seed}"), folder)


@cache
def scenes():
    """Scenes of the repository as trees."""
    return [_plain(path) for path in sorted(CONFIG.glob("scenes/*/*.yaml"))]


@cache
def studies():
    """Study files of the repository that have grids, by paper."""
    files = {path.stem: _plain(path) for path in sorted(CONFIG.glob("studies/*.yaml"))}
    return [(paper, tree) for paper, tree in files.items() if tree["studies"]]


def _plain(path):
    return YAML(typ="safe", pure=True).load(path)
