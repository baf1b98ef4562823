"""The command line: exit codes, one message, no file made when refused."""

import json
import os
import re
import resource
import subprocess
import sys
from importlib.metadata import version
from pathlib import Path

import pytest
import xarray as xr

from riserstudy.simulation.compile import compile_once
from riserstudy.simulation.error_estimate import controlled

SCENES = Path(__file__).parents[1] / "config" / "scenes"
CURRENT, SURGE = str(SCENES / "bench/s1.yaml"), str(SCENES / "bench/s2.yaml")
QUICK = ["--set", "analysis.duration=30 s"]


@pytest.fixture
def command(commands):
    """Run a command here; its exit code, output and messages, without that of compiling."""
    compile_once(lambda _: None)
    return commands


def test_a_run_writes_its_dataset_and_says_how_good_it_is(command, tmp_path):
    code, out, err = command("run", SURGE, "-o", tmp_path / "out.nc", *QUICK)
    assert (code, err) == (0, "")
    assert "estimated error" in out
    with xr.open_dataset(tmp_path / "out.nc") as found:
        assert float(found["time"][-1]) == 30.0


@pytest.mark.long
def test_a_run_loads_no_library_that_it_has_no_use_for(tmp_path):
    # each of them takes longer to load than a short run takes
    said = (
        "import sys; from riserstudy.cli import main; main(); "
        "print(*{'dask', 'pint', 'scipy.integrate', 'scipy.interpolate', 'scipy.optimize', 'scipy.sparse',"
        " 'scipy.spatial', 'matplotlib', 'plotly'} & {*sys.modules})"
    )
    run = [sys.executable, "-c", said, "run", SURGE, "-o", str(tmp_path / "out.nc"), *QUICK]
    done = subprocess.run(run, capture_output=True, text=True, check=True)
    assert done.stdout.splitlines()[1:] == [f"written: {tmp_path / 'out.nc'}", ""]


def test_accuracy_and_settings_reach_the_run(command, tmp_path):
    target = tmp_path / "out.nc"
    settings = ["--set", "current.profile[1].speed=0.5 m/s", "--accuracy", "0.5%"]
    assert command("run", CURRENT, "-o", target, *settings)[0] == 0
    with xr.open_dataset(target) as found:
        assert max(controlled(json.loads(found.attrs["error_estimate"])).values()) <= 0.005
        tree = json.loads(found.attrs["provenance"])["scene"]
    assert tree["current"]["profile"][1]["speed"] == "0.5 m/s"
    assert "mesh" not in tree["analysis"]


@pytest.mark.long
def test_patience_writes_the_best_result_so_far_and_says_so(command, tmp_path):
    target = tmp_path / "out.nc"
    wanted = ["--accuracy", "1e-5 %", "--patience", "0.02 min"]
    code, _, err = command("run", SURGE, "-o", target, *QUICK, *wanted)
    assert code == 0
    assert "riserstudy: warning: accuracy not reached within the time limit of 1.2 s after " in err
    with xr.open_dataset(target) as found:
        assert found.attrs["ended_by"] == "patience of 1.2 s"
        assert "within the time limit" in json.loads(found.attrs["warnings"])[-1]
        assert float(found["time"][-1]) == 30.0


@pytest.mark.long
def test_patience_that_ends_before_any_run_leaves_nothing(command, tmp_path):
    long = ["--set", "analysis.duration=1e6 s", "--set", "analysis.output.interval=10 s"]
    own = ["--set", "analysis.mesh={elements: 8}", "--set", "analysis.step=2 ms"]
    target = tmp_path / "out.nc"
    code, _, err = command("run", SURGE, "-o", target, *long, *own, "--patience", "1")
    assert code == 3
    assert err.startswith("riserstudy: analysis.mesh, analysis.step: the run exceeds the time limit of 1 s")
    assert not target.exists()


@pytest.mark.parametrize("patience", ["0", "-3", "3 m", "soon", "nan"])
def test_a_patience_that_is_no_time_is_refused(command, tmp_path, patience):
    code, _, err = command("run", SURGE, "-o", tmp_path / "out.nc", "--patience", patience)
    assert code == 2
    assert err.startswith("riserstudy: patience: ")
    assert err.count("\n") == 1


@pytest.mark.long
def test_a_terminal_shows_what_is_run(tmp_path):
    """On a terminal of its own, which a pipe is not."""
    pty = pytest.importorskip("pty")
    mine, its = pty.openpty()
    longer = ["--set", "analysis.duration=200 s"]
    words = ["run", SURGE, "-o", tmp_path / "out.nc", *longer, "--accuracy", "0.03 %"]
    with subprocess.Popen(
        [Path(sys.executable).with_name("riserstudy"), *words], stdout=its, stderr=its
    ) as command:
        os.close(its)
        said = b""
        while piece := _read(mine):
            said += piece
    os.close(mine)
    assert command.returncode == 0
    assert re.search(
        rb"run \d+: \d+ segments, steps of [\d.e-]+ s; error of moment .* to\s+go", said, re.DOTALL
    ), said


def _read(terminal):
    """What stands on a terminal; nothing once the other side is closed."""
    try:
        return os.read(terminal, 4096)
    except OSError:
        return b""


def test_a_rerun_writes_all_of_the_run_and_never_over_what_it_reads(command, tmp_path):
    one, all_of_it = tmp_path / "one.nc", tmp_path / "all.nc"
    assert command("run", SURGE, "-o", one, *QUICK)[0] == 0
    with xr.open_dataset(one) as dataset:
        dataset.drop_vars("x").to_netcdf(tmp_path / "less.nc")
    code, out, _ = command("rerun", tmp_path / "less.nc", "-o", all_of_it)
    assert (code, out.splitlines()[-1][:2]) == (0, "0 ")
    with xr.open_dataset(one) as dataset, xr.open_dataset(all_of_it) as other:
        assert {*other.variables} == {*dataset.variables}
        xr.testing.assert_allclose(other["x"], dataset["x"], rtol=1e-9)
    code, _, err = command("rerun", one, "-o", one)
    assert (code, "an input of this command" in err) == (2, True)


def test_a_scene_is_drawn_in_the_format_of_the_ending(command, tmp_path):
    assert command("draw", SURGE, "-o", tmp_path / "a.png")[0] == 0
    assert (tmp_path / "a.png").read_bytes().startswith(b"\x89PNG")
    code, _, err = command("draw", SURGE, "-o", tmp_path / "a.jpg")
    assert code == 2
    assert "the ending '.jpg' is wrong" in err
    assert {path.name for path in tmp_path.iterdir()} == {"a.png"}


REFUSED = {
    "an unknown key": [SURGE, "--set", "colour=red"],
    "a wrong unit": [SURGE, "--set", "riser[0].length=5 kg"],
    "a path that leads nowhere": [SURGE, "--set", "riser[9].length=5 m"],
    "no value": [SURGE, "--set", "riser"],
    "no path": [SURGE, "--set", "=5"],
    "a tag": [SURGE, "--set", "title=!!python/name:os.system"],
    "a broken value": [SURGE, "--set", "title=[1, 2"],
    "an accuracy of nothing": [SURGE, "--accuracy", "0%"],
    "an accuracy below nothing": [SURGE, "--accuracy", "-3%"],
    "an accuracy of no number": [SURGE, "--accuracy", "good"],
    "no such scene": ["absent.yaml"],
    "no such option": [SURGE, "--colour"],
}


@pytest.mark.parametrize("case", REFUSED)
def test_a_refused_run_ends_with_two_one_message_and_no_file(command, tmp_path, case, monkeypatch):
    monkeypatch.chdir(tmp_path)
    code, out, err = command("run", *REFUSED[case], "-o", tmp_path / "out.nc")
    assert code == 2
    assert out == ""
    assert err.startswith("riserstudy: ")
    assert err.count("\n") == 1
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("subcommand", ["run", "modes"])
def test_an_output_that_cannot_be_written_is_refused_before_anything_runs(command, tmp_path, subcommand):
    for target in (tmp_path, tmp_path / "no" / "such" / "folder.nc"):
        code, out, err = command(subcommand, SURGE, "-o", target)
        assert (code, out) == (2, "")
        assert "--output" in err
    assert list(tmp_path.iterdir()) == []


def test_an_output_never_takes_the_place_of_a_link_a_device_or_the_scene(command, tmp_path):
    scene, link = tmp_path / "scene.yaml", tmp_path / "link.nc"
    scene.write_text(Path(SURGE).read_text())
    link.symlink_to("elsewhere.nc")
    for target in (scene, link, "/dev/null"):
        code, _, err = command("run", scene, "-o", target, *QUICK)
        assert (code, err.count("\n")) == (2, 1)
    assert scene.read_text() == Path(SURGE).read_text()
    assert {path.name for path in tmp_path.iterdir()} == {"scene.yaml", "link.nc"}


def test_a_run_without_output_is_refused(command):
    assert command("run", SURGE)[0] == 2


def test_an_unknown_command_is_refused(command):
    code, _, err = command("sink")
    assert code == 2
    assert "sink" in err


def test_a_simulation_that_cannot_be_completed_ends_with_three(command, tmp_path):
    heavy = ["--set", "current=null", "--set", "top.tension=30 kN"]  # of a weight of 75 kN
    code, _, err = command("run", CURRENT, "-o", tmp_path / "out.nc", *heavy)
    assert code == 3
    assert err.count("\n") == 1
    assert list(tmp_path.iterdir()) == []


@pytest.mark.long
@pytest.mark.parametrize(
    "words, name",
    [
        (["run", SURGE, *QUICK, "-o"], "out.nc"),
        (["run", SURGE, *QUICK, "-o"], "out.csv"),
        (["draw", SURGE, "-o"], "out.png"),
        (["draw", SURGE, "-o"], "out.pdf"),
        (["draw", SURGE, "-o"], "out.svg"),
        (["cost", SURGE, *QUICK, "--plot"], "out.png"),
    ],
    ids=["run", "table of a run", "draw png", "draw pdf", "draw svg", "cost"],
)
def test_a_full_disk_ends_with_three_and_leaves_nothing(command, tmp_path, words, name):
    target, limits = tmp_path / name, resource.getrlimit(resource.RLIMIT_FSIZE)
    assert command(*words, target)[0] == 0  # kernels are there from now on
    target.unlink()
    resource.setrlimit(resource.RLIMIT_FSIZE, (1000, limits[1]))
    try:
        code, _, err = command(*words, target)
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, limits)
    assert code == 3
    assert err.startswith(f"riserstudy: {target} cannot be written")
    assert err.count("\n") == 1
    assert list(tmp_path.iterdir()) == []


def test_cost_tells_what_accuracy_takes(command, tmp_path):
    picture = tmp_path / "cost.png"
    code, said, complaint = command("cost", SURGE, "--set", "analysis.duration=10 s", "--plot", picture)
    assert code == 0, complaint
    *lines, written = said.splitlines()
    assert written == f"written: {picture}"
    requests = [line[:9].strip() for line in lines[1:]]
    assert requests == ["5 %", "1 %", "default", "0.2 %", "0.05 %"]
    segments = [int(line[9:].split()[2]) for line in lines[1:]]
    assert segments == sorted(segments)
    assert picture.stat().st_size > 1000


@pytest.mark.long
def test_a_long_run_is_priced_and_announced(command, tmp_path, monkeypatch):
    long = ["--set", "analysis.duration=3 h", "--set", "analysis.output.interval=10 s"]
    code, said, complaint = command("cost", SURGE, *long)
    assert code == 0, complaint
    seconds = [float(line.split()[-2]) for line in said.splitlines()[1:]]
    assert len(seconds) > 1
    assert min(seconds) > 0.0
    monkeypatch.setattr("riserstudy.cli.shared.NOTEWORTHY", 0.0)
    monkeypatch.setattr("riserstudy.simulation.progress_line.LATE", 0.0)
    code, _, told = command("run", SURGE, "-o", tmp_path / "out.nc", *long, "--accuracy", "5%")
    assert code == 0
    assert "\nriserstudy: takes about " in told
    assert "segments, step" in told


def test_effects_tells_what_is_on_and_what_could_be(command):
    code, out, _ = command("effects", SURGE)
    assert code == 0
    assert "added mass" in out
    assert "could be" in next(line for line in out.splitlines() if "needs current" in line)
    assert "needs top.tensioners" not in out
    assert "Degrees of freedom: in the plane of x and z (platform.surge)." in out
    code, whole, _ = command("effects", SURGE, "--all", "--times")
    assert code == 0
    assert "needs top.tensioners" in whole
    assert "Timed on" in whole


def test_advise_says_first_what_could_go_and_what_is_missing(command):
    short = [
        "--set",
        "analysis.duration=5 s",
        "--set",
        "analysis.step=0.1 s",
        "--set",
        "analysis.mesh.elements=10",
    ]
    code, out, _ = command("advise", SURGE, *short)
    assert code == 0
    could, missing = out.index("Removable, one at a time"), out.index("Recommended:")
    assert could < missing < out.index("without surge")
    assert "medians of 5 runs" in out


def test_the_version_is_that_of_the_package(command):
    code, out, _ = command("--version")
    assert (code, out.strip()) == (0, f"riserstudy {version('riserstudy')}")


def test_modes_prints_the_lowest_frequencies(command, tmp_path):
    code, out, _ = command("modes", SCENES / "bench/s4a.yaml", "--count", "3", "-o", tmp_path / "m.nc")
    assert code == 0
    assert out.count("lateral") == 3
    with xr.open_dataset(tmp_path / "m.nc") as found:
        assert found.sizes["mode"] == 3


def test_schema_prints_json(command):
    code, out, _ = command("schema")
    assert code == 0
    assert json.loads(out)["$schema"].startswith("https://json-schema.org/")


def test_results_without_a_database_names_what_makes_it(command, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    code, out, error = command("results", "no such point ever")
    assert (code, out) == (2, "")
    assert "make study" in error


@pytest.mark.long
def test_the_installed_command_gives_the_exit_codes_too(tmp_path):
    def code(*arguments):
        return subprocess.run(
            [Path(sys.executable).with_name("riserstudy"), *arguments],
            cwd=tmp_path,
            capture_output=True,
            text=True,
            check=False,
        )

    assert code("run", SURGE, "-o", "out.nc", *QUICK).returncode == 0
    refused = code("run", SURGE, "-o", "no.nc", "--set", "top.tension=3 t")
    assert refused.returncode == 2
    assert "Traceback" not in refused.stderr
    assert [p.name for p in tmp_path.iterdir()] == ["out.nc"]


def test_diff_says_by_its_exit_status_whether_something_changed(command, tmp_path):
    for name, value in (("one", 1.0), ("same", 1.0), ("other", 2.0)):
        xr.Dataset({"x": ("k", [value, 3.0])}).to_netcdf(tmp_path / f"{name}.nc")
    assert command("diff", tmp_path / "one.nc", tmp_path / "same.nc")[0] == 0
    code, out, _ = command("diff", tmp_path / "one.nc", tmp_path / "other.nc")
    assert code == 1
    assert "1 of 1 variables changed" in out


def test_words_of_a_scene_are_printed_as_written(command, tmp_path):
    words = r"a [b] [/c] [red] d"
    scene = tmp_path / "scene.yaml"
    text = (SCENES / "bench/s4b.yaml").read_text("utf-8").splitlines()
    scene.write_text("\n".join([f"title: '{words}'", *text[2:]]), "utf-8")
    code, out, _ = command("effects", scene)
    assert code == 0
    assert words in " ".join(out.split())
