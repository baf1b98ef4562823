"""The same study through Slurm, on a node of our own: `make test-cluster`, as root."""

import os
import subprocess
import sys
import time
from pathlib import Path

import psutil
import pytest
import xarray as xr
from ruamel.yaml import YAML
from test_pipeline import assert_same_numbers

pytestmark = pytest.mark.cluster
HERE = Path(__file__).parent
PROFILE = HERE.parents[1] / "workflow/profiles/slurm"
OF_THIS_NODE = [
    *("--slurm-status-command", "squeue", "--slurm-no-account"),
    *("--slurm-init-seconds-before-status-checks", "3", "--seconds-between-status-checks", "3"),
    *("--default-resources", "slurm_partition=one_node", "runtime=30", "mem_mb=500"),
    *("--latency-wait", "5", "--max-threads", "1"),
]
#: words of rows that state how long a step or a run takes on this machine
OF_TIMES = (" One time step takes ", ",elapsed time of ")


@pytest.fixture(scope="module")
def slurm(tmp_path_factory):
    """Environment with the commands of the node, and with Python in a path without a blank."""
    folder = tmp_path_factory.mktemp("node")
    (folder / "python").symlink_to(sys.prefix)
    script = str(HERE / "one_node_slurm.sh")
    subprocess.run([script, "start", str(folder)], check=True)
    yield {"PATH": os.pathsep.join([f"{folder / 'bin'}", f"{folder / 'python/bin'}", os.environ["PATH"]])}
    subprocess.run([script, "stop", str(folder)], check=True)


def start(checkout, slurm, *targets):
    """Start Snakemake with the profile; what it says goes to a file."""
    command = ["python", "-m", "snakemake", *targets, "--nocolor"]
    with (checkout / "said").open("w") as said:
        return subprocess.Popen(
            [*command, "--profile", PROFILE, *OF_THIS_NODE],
            cwd=checkout.folder,
            env=checkout.environment | slurm,
            stdout=said,
            stderr=subprocess.STDOUT,
        )


def process_of(job):
    """A living process that Slurm started, by words of its command."""
    for process in psutil.process_iter(["cmdline", "environ"]):
        if "SLURM_JOB_ID" in (process.info["environ"] or {}):
            words = process.info["cmdline"] or []
            if set(job) <= set(words) and "sh" not in Path(words[0]).name:
                return process
    return None


def test_a_python_in_a_path_with_a_blank_submits_no_job(fresh, slurm, tmp_path):
    (tmp_path / "a python").symlink_to(sys.prefix)
    elsewhere = {"PATH": f"{tmp_path / 'a python/bin'}{os.pathsep}{slurm['PATH']}"}
    assert start(fresh, elsewhere, "chang2020").wait(300) == 2
    said = (fresh / "said").read_text()
    assert "ln -s" in said
    assert "Traceback" not in said
    assert not (fresh / ".snakemake/slurm_logs").exists()


def test_shards_on_slurm_one_of_them_killed_give_the_numbers_of_one_local_job(fresh, finished, slurm):
    fresh.edit("config/config.yaml", "tier: standard", "tier: standard\npoints_per_job: 5")
    run = start(fresh, slurm, "chang2020", "--config", "points_per_job=5")
    while not (job := process_of(["riserstudy.jobs", "shard", "quasi_static"])):
        assert run.poll() is None, (fresh / "said").read_text()
        time.sleep(0.05)
    job.kill()
    assert run.wait(1500) == 0, (fresh / "said").read_text()
    said = (fresh / "said").read_text()
    assert "riserstudy: the failed step starts again" in said
    assert_same_numbers(fresh, finished)
    assert len(fresh.stored()) == len(finished.stored())
    assert "0 points simulated" in (fresh / "logs/chang2020/quasi_static.log").read_text()
    assert fresh.planned() == set()


def test_whole_papers_through_slurm_give_the_numbers_of_a_local_run(fresh, slurm):
    root = HERE.parents[1]
    everything = YAML().load(root / "config/config.yaml")["papers"]
    all_but_times = " ".join(paper for paper in everything if paper != "numerics")
    papers = os.environ.get("RISERSTUDY_CLUSTER_PAPERS", all_but_times).split()
    for part in ("config/studies", "config/published", "chapters"):
        subprocess.run(["cp", "-r", root / part, (fresh / part).parent], check=True)
    fresh.edit("config/config.yaml", "papers:\n- chang2020", f"papers: [{', '.join(papers)}]")
    fresh.edit("config/config.yaml", "tier: standard", "tier: preview")
    run = start(fresh, slurm, *papers)
    assert run.wait(3600) == 0, (fresh / "said").read_text()
    through_slurm = {
        path.relative_to(fresh / "results"): xr.load_dataset(path)
        for path in (fresh / "results").glob("*/*.nc")
    }
    assert through_slurm
    tables = {path: untimed(path) for path in (fresh / "results").glob("*/*.csv")}
    for path in [*(fresh / ".cache/points").glob("*/*.point2"), *(fresh / "results").glob("*/*.*")]:
        path.unlink()
    status, _, complained = fresh.run("--tier", "preview", *papers, timeout=1800)
    assert (status, complained) == (0, "")
    for path, dataset in through_slurm.items():
        local = xr.load_dataset(fresh / "results" / path)
        timed = [name for name in local if name.endswith("seconds")]
        xr.testing.assert_identical(dataset.drop_vars(timed), local.drop_vars(timed))
    assert tables == {path: untimed(path) for path in tables}


def untimed(path):
    """The rows of a table without those that state times: an erratum, and a panel of a figure."""
    return [row for row in path.read_text().splitlines() if not any(words in row for words in OF_TIMES)]


STRING = """\
title: a string at rest
water: {density: 1025 kg/m^3, seabed: 0 m, surface: 1000 m}
riser:
  - name: string
    length: 990 m
    outer_diameter: 0.5334 m
    axial_stiffness: 1e12 N
    mass: 500 kg/m
    submerged_weight: 2 kN/m
    drag: {coefficient: 1.0, diameter: 0.5334 m}
bottom: {hold: wellhead, elevation: 0 m}
top: {x: held, z: free, tension: 4 MN}
analysis: {mesh: {elements: 4}}
"""
GRID = """\
paper: grids
studies:
  strings:
    scene: scenes/string.yaml
    caption: strings at rest
    keep: [effective_tension]
    axes:
      tension: {path: top.tension, unit: kN, values: {start: 4000, stop: 4990, step: 10}}
      mass: {path: "riser[0].mass", unit: kg/m, values: {start: 501, stop: MOST, step: 1}}
      weight: {path: "riser[0].submerged_weight", unit: N/m, values: {start: 2000, stop: 2990, step: 10}}
"""
SHARDS = 20
PLANE = 10_000  # points for one mass


def test_many_short_points_in_twenty_shards(fresh, slurm):
    """RISERSTUDY_CLUSTER_POINTS says how many strings, in ten thousands."""
    masses = int(os.environ.get("RISERSTUDY_CLUSTER_POINTS", PLANE)) // PLANE
    (fresh / "config/scenes/string.yaml").write_text(STRING)
    (fresh / "config/studies/grids.yaml").write_text(GRID.replace("MOST", str(500 + masses)))
    part = masses * PLANE // SHARDS
    settings = f"papers: [grids]\ntier: standard\ntiers: {{standard: {{}}}}\npoints_per_job: {part}\n"
    (fresh / "config/config.yaml").write_text(settings)
    run = start(fresh, slurm, "grids", "--config", f"points_per_job={part}")
    assert run.wait(10_000) == 0, (fresh / "said").read_text()
    assert len([*(fresh / "logs/grids").glob("strings.*-of-*")]) == SHARDS
    found = xr.load_dataset(fresh / "results/grids/strings.nc")
    upper, lower = (found["effective_tension"].isel(s=k) for k in (-1, 0))
    assert upper.size == masses * PLANE
    pull, hung = 1e3 * found["tension"], 990.0 * found["weight"]
    assert float(abs(upper / pull - 1.0).max()) < 1e-9
    assert float(abs(lower / (pull - hung) - 1.0).max()) < 1e-9
    assert len([path for path in (fresh / ".cache/points").rglob("*") if path.is_file()]) < 2000
    assert fresh.planned("grids") == set()
