"""A small real workspace: studies of two papers, simulated in milliseconds, with hostile names in them."""

import csv
import json
import shutil
from pathlib import Path

import numpy as np
import xarray as xr
from ruamel.yaml import YAML

from riserstudy.database.ask import NAME
from riserstudy.database.build import build
from riserstudy.database.sources import Sources
from riserstudy.dataset.write_dataset import write_dataset
from riserstudy.records.graded import Grounds, Influence, Share
from riserstudy.study.collect import dataset_of, results_of
from riserstudy.study.read import read_studies
from riserstudy.study.study import Study

SCENES = Path(__file__).parents[2] / "config/scenes"
PAPERS = ["odd", "plain"]
RESULTS = Path("results")
DATABASE = RESULTS / NAME
INJECTION = "'); drop table points; --"
LABELS = ["o'clock", '"quoted"', INJECTION, "Überlast ≥ 3 µm", "", "1"]
BRIEF = {"analysis.duration": "20 s", "analysis.output.interval": "1 s"}
PRESCRIBED = BRIEF | {"analysis.mesh": {"elements": 8}, "analysis.step": "0.1 s"}
AMPLITUDES = {"path": "platform.surge.amplitude", "unit": "m", "values": [1.0, 2.5]}
PERIODS = {"path": "platform.surge.period", "unit": "s", "values": [9.0, 12.0, 15.0]}


def studies():
    """Study files by paper."""
    surge = {"scene": "scenes/surge.yaml", "set": PRESCRIBED}
    meshes = {
        "coarse": {},
        "fine": {"analysis.mesh": {"elements": 16}},
        "shorter": {"riser[0].length": "500 m", "analysis.duration": "12 s"},
    }
    plain = {
        "surge": {**surge, "caption": "surge", "axes": {"amplitude": AMPLITUDES, "period": PERIODS}},
        "meshes": {**surge, "caption": "several meshes", "axes": {"mesh": dict(meshes)}},
        "sampled": {
            **surge,
            "caption": "open values",
            "axes": {"sample": {"count": dict.fromkeys(TIERS, 4), "seed": 1}},
            "keep": ["bending_moment_max", "bending_moment_min", "x", "x_max"],
        },
        "one": {**surge, "caption": "a single point", "axes": {}},
        "static": {"scene": "scenes/load.yaml", "caption": "statics", "axes": {}},
    }
    named = {"path": "riser[0].drag.coefficient", "unit": "1", "values": [0.5, 1.0]}
    point = {"path": "platform.surge.amplitude", "unit": "m", "values": [1.0, 2.0]}
    axes = {"select": {}, "group": point, "Key": named}
    axes["rowid"] = {"a": {}, "b": {"platform.surge.period": "11 s"}}
    for number, label in enumerate(LABELS):
        axes["select"][label] = {"platform.surge.ramp": f"{10 + number} s"}
    odd = {
        "Order-by_1": {**surge, "caption": INJECTION, "axes": axes, "keep": ["x_max", "x_absmax"]},
        "order-by_1": {**surge, "caption": "as before, but for case", "axes": {"Group": point}},
    }
    shown = {"caption": INJECTION, "reads": ["Order-by_1"], "plot": "lines"}
    return {
        "plain": {
            "paper": "plain",
            "studies": plain,
            "derived": {"swing": ["surge", "meshes"]},
            "figures": {"one": {"caption": "surge", "reads": ["swing"], "plot": "lines"}},
        },
        "odd": {"paper": "odd", "studies": odd, "figures": {"fig1": shown}},
    }


TIERS = ("preview", "standard", "reference")


def lay_out():
    """Write configuration and scenes into the folder where one is."""
    Path("config/scenes").mkdir(parents=True)
    Path("config/studies").mkdir()
    yaml = YAML()
    scene = yaml.load(SCENES / "bench/s2.yaml")
    scene["title"] = INJECTION
    surge = scene["platform"]["surge"]
    surge["amplitude"] = {"assumed": "2 m", "range": ["1 m", "3 m"], "because": INJECTION}
    surge["period"] = {"derived": "15 s", "from": "it's printed"}
    yaml.dump(scene, Path("config/scenes/surge.yaml"))
    shutil.copy(SCENES / "bench/s4b.yaml", "config/scenes/load.yaml")
    Path("chapters/plain").mkdir(parents=True)
    Path("chapters/plain/derived.py").write_text("def swing(surge, meshes):\n    return surge\n")
    for paper, tree in studies().items():
        yaml.dump(json.loads(json.dumps(tree)), Path(f"config/studies/{paper}.yaml"))
    tiers = {tier: {"accuracy": "5 %"} for tier in TIERS}
    settings = {"papers": PAPERS, "tier": "standard", "tiers": tiers}
    yaml.dump(settings, Path("config/config.yaml"))


def simulate(paper, name):
    """Make the dataset of a study."""
    model = read_studies(Path("config"), paper).studies[name]
    study = Study(paper, name, model, Path("config"), "standard", "5 %")
    write_dataset(dataset_of(study, results_of(study, 1, lambda _: None)[0]), RESULTS / paper / f"{name}.nc")


def swing(scale=1.0):
    """A derived dataset with grids over different axes, texts, whole numbers and no number at all."""
    rng = np.random.default_rng(5)
    values = scale * rng.standard_normal((2, 3))
    values[0, 1] = np.nan
    data = {
        "swing": (("amplitude", "period"), values, {"units": "N"}),
        "count": (("amplitude", "period"), np.arange(6).reshape(2, 3)),
        "größe ≥ 1": (("amplitude", "period"), values - 1.0),
        "verdict": ("naïve axis", np.array(["fails", INJECTION, ""], dtype=object)),
        "largest": ("naïve axis", [np.inf, -0.0, 1e-308]),
    }
    coords = {"amplitude": ("amplitude", [1.0, 2.5], {"units": "m"}), "period": [9.0, 12.0, 15.0]}
    return xr.Dataset(data, coords | {"naïve axis": ["a", "o'b", '"']})


GROUNDS = Grounds(
    share=Share(2, 8, 8), because="inputs", decided_by=[Influence("t", "period; in s: 9. Or 12")]
)


def graded():
    """Write the tables over all papers."""
    row = {"paper": "plain", "figure": "3", "kind": "number", "statement": INJECTION}
    row |= {"published": "0.1", "simulated": repr(0.1 + 0.2), "unit": "1", "error": "2.0"}
    row |= {
        "id": "A1",
        "verdict": "depends",
        "depends_on": "period; in s: 9. Or 12; met in 2 of 8 samples",
        "note": "True in 3 of 9 samples; or so.",  # of no account
        "grounds": GROUNDS.to_json(),
        "margin": "-0.3",
        "margin_low": "-0.5",
        "margin_high": "0.25",
    }
    _write("reproduction", [row, row | {"id": "A2", "published": "", "error": ""}])
    case = {"base": 0, "judged": 1, "met": 1, "same": 0, "calibrated": 0}
    case |= {"rests_on": '{"plain/surge": []}'}
    margins = {'{"sample": 0}': "0.25", '{"sample": 1, "line": "a; b"}': "-0.5", "{}": ""}
    _write(
        "margins",
        [{"paper": "plain", "id": "A1", "place": p, "margin": m} | case for p, m in margins.items()],
    )
    known = {"paper": "plain", "id": "E1", "where": "p. 3", "printed": "a", "reading": "b"}
    _write("errata", [known | {"simulation": INJECTION}])


def _write(name, rows):
    with (RESULTS / f"{name}.csv").open("w", newline="") as file:
        writer = csv.DictWriter(file, rows[0])
        writer.writeheader()
        writer.writerows(rows)


def figures():
    """Write what stands for figures."""
    for figure in ("plain/one", "odd/fig1"):
        for ending in ("png", "pdf"):
            (RESULTS / f"{figure}.{ending}").write_bytes(f"{figure} {ending}".encode())


def sources():
    """What the database is built from: all that is there."""
    files = [path for path in sorted(RESULTS.rglob("*")) if path.suffix in (".nc", ".png", ".pdf")]
    return Sources(Path("config"), PAPERS, [*files, *sorted(RESULTS.glob("*.csv"))])


def built():
    """Build the database of what is there."""
    return build(DATABASE, sources())


def make():
    """Everything, in the folder where one is."""
    lay_out()
    for paper, tree in studies().items():
        for name in tree["studies"]:
            simulate(paper, name)
    write_dataset(swing(), RESULTS / "plain/swing.nc")
    graded()
    figures()
    built()
