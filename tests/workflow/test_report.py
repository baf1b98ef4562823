"""The report, made of the results of the workflow in small."""

import csv
import re
import shutil
from html.parser import HTMLParser

import pytest

from riserstudy.database.ask import connect
from riserstudy.database.build import build
from riserstudy.database.sources import Sources as Built
from riserstudy.grading.rows import Row, row_of, table
from riserstudy.records.graded import Graded, Grounds, Influence, Outcome, Share
from riserstudy.report import render, write_report
from riserstudy.report.claims import read_claims
from riserstudy.report.contents import Sources
from riserstudy.report.formats import share

pytestmark = pytest.mark.long

FLOW = Influence("flow", "the flow; U: m/s", by_option={"along, 1 m/s": 0.694, "against (2)": 1.0})
PHASE = Influence("phase", "the phase", by_option={"early": 0.5, "late; or never": 0.0})
ROWS = [
    Graded(
        *("chang2020", "A1", "14", "number", "a <b>bold</b> number", 0.3, 0.538921, "m", 0.7964),
        "depends",
        Grounds(share=Share(1, 4, 4), because="inputs", decided_by=[PHASE], note="A note."),
    ),
    Graded(
        *("chang2020", "A2", "14", "claim", "a claim", None, 1.5, "1", None, "holds"),
        Grounds(share=Share(256, 256, 256), outcomes=[Outcome("Base case", 1.5, 1.5, True)]),
        margin=0.25,
    ),
    Graded(
        *("chang2020", "A10", "14", "claim", "open", None, 0.0, "1", None, "depends"),
        Grounds(
            share=Share(200, 256, 256, 0.7271, 0.8274),
            because="inputs",
            decided_by=[FLOW],
            outcomes=[Outcome("Base case", 3.0, 3.0, True)],
            note="As in A1.",
        ),
        *(0.1, -0.02, 0.3),
    ),
    Graded(
        *("chang2020", "A4", "14", "claim", "open too", None, -1e-300, "1", None, "depends"),
        Grounds(share=Share(3, 8, 8), because="inputs"),
    ),
    Graded(
        *("other2021", "B1", "", "claim", "of another", None, None, "1", None, "not reproducible"),
        Grounds(impossible="nothing said"),
    ),
    Graded(
        *("other2021", "B0", "2", "number", "nearly met", -3.14159e6, -3.14159e6, "N", 0.0),
        "reproduced",
        Grounds(share=Share(254, 256, 256, 0.9718, 0.9979)),
    ),
]
REPRODUCTION = table(map(row_of, ROWS), Row)
ERRATA = """\
paper,id,where,printed,reading,simulation
chang2020,E1,Eq. 3,a slip,read so,says this
"""


@pytest.fixture(scope="module")
def sources(finished, tmp_path_factory):
    folder = tmp_path_factory.mktemp("report")
    results = folder / "results"
    shutil.copytree(finished / "results", results)
    tables = [results / "reproduction.csv", results / "errata.csv"]
    for path, text in zip(tables, (REPRODUCTION, ERRATA), strict=True):
        path.write_text(text)
    marker = folder / "compiled"
    marker.write_text('{"cold_seconds": 81.5}')
    return built(Sources(finished / "config", ["chang2020"], results / "results.sqlite", marker))


def built(sources):
    """The sources with their database as it is after the workflow."""
    sources.database.unlink(missing_ok=True)
    kinds = ("nc", "png", "pdf", "csv")
    files = [path for kind in kinds for path in sorted(sources.folder.glob(f"*/*.{kind}"))]
    of_all = sorted(sources.folder.glob("*.csv"))
    papers = ["chang2020", "other2021"] if of_all else ["chang2020"]
    config = sources.folder.parent / "config"
    shutil.copytree(sources.config, config, dirs_exist_ok=True)
    if of_all:  # the database knows all papers of its tables
        (config / "studies/other2021.yaml").write_text("paper: other2021\nstudies: {}\n")
    tables = [p for p in files if p.stem not in ("reproduction", "errata")]
    build(sources.database, Built(config, papers, [*tables, *of_all]))
    return sources


class Page(HTMLParser):
    """Tags, addresses and text of a page; complains about tags that do not match."""

    def __init__(self, text):
        super().__init__()
        self.open, self.addresses, self.anchors, self.words = [], [], set(), []
        self.feed(text)
        assert self.open == []

    def handle_starttag(self, tag, attributes):
        found = dict(attributes)
        self.addresses += [found[name] for name in ("src", "href") if name in found]
        self.anchors |= {found["id"]} if "id" in found else set()
        if tag == "img" and "alt" not in found:
            raise AssertionError(f"no words for an image: {self.getpos()}")
        if tag not in ("img", "meta", "link", "br", "wbr"):
            self.open.append(tag)

    def handle_endtag(self, tag):
        assert self.open.pop() == tag

    def handle_data(self, data):
        self.words += data.split()


def test_the_page_is_whole_and_needs_no_network(sources):
    page = Page(render(sources))
    inside = [a for a in page.addresses if a.startswith("#")]
    assert {a[1:] for a in inside} <= page.anchors
    images = [a for a in page.addresses if a.startswith("data:image/webp;base64,")]
    drawn = [*sources.folder.glob("*/*.png")]
    assert len(images) == len(drawn) > 0
    papers = [a for a in page.addresses if a.startswith("https://doi.org/10.")]
    assert papers
    beside = [a for a in page.addresses if a not in inside and a not in images and a not in papers]
    assert beside
    assert all((sources.folder / a).is_file() for a in beside)


def test_every_figure_leads_to_its_claims_scene_files_and_command(sources):
    card = re.search(r'<figure id="chang2020-fig14">(.*?)</figure>', render(sources), re.DOTALL)[1]
    for wanted in ("#claim-chang2020-A1", "#scene-chang2020-", "fig14.pdf", "fig14.csv", ".nc"):
        assert wanted in card
    assert "snakemake -c1 chang2020_fig14" in card
    alt = re.search(r'alt="([^"]*)"', card)[1]
    assert "asymmetry index" in alt
    assert "heave amplitude" in alt


def test_the_values_that_a_figure_shows_stand_beside_it(sources):
    with (sources.folder / "chang2020/fig14.csv").open(newline="") as file:
        rows = list(csv.DictReader(file))
    assert {row["y"] for row in rows} == {"asymmetry index S = x_p / x_n"}
    assert all(float(row["x_value"]) > 0.0 for row in rows if row["series"])


def test_every_claim_leads_to_its_figure(sources):
    page = render(sources)
    for name in ("A1", "A2"):
        row = re.search(rf'<tr id="claim-chang2020-{name}".*?</tr>', page, re.DOTALL)[0]
        assert 'href="#chang2020-fig14"' in row


def test_the_page_tells_verdicts_errata_scenes_and_times(sources):
    text = " ".join(Page(render(sources)).words)
    assert "A <b>bold</b> number. The verdict depends on the input “the phase”." in text
    assert "early: 50 % late; or never: 0 %" in text
    assert "0.3 m 0.5389 m 80 % met in 25 % of samples depends" in text
    assert "The claim is true in all 256 samples." in text
    assert "E1 Eq. 3 A slip. Read so. says this" in text
    pressure = r"top.tensioners.gas.pressure 190.2 bar absolute [a-z_, ]+ assumed the table gives bar"
    assert re.search(pressure, text)
    assert re.search(r"platform.heave.amplitude varied [a-z_, ]+ axis heave_amplitude", text)
    assert "“tensioner model” has 2 options: “gas law”; “linear”." in text
    assert "The elapsed times of the simulations add up to" in text
    assert "Compiling the engine took 81.5 s" in text
    assert "CPU time" not in text  # each point has its elapsed time, whatever else the machine did
    assert "One paper on drilling risers, simulated again" in text


def test_bars_count_what_the_tables_hold(sources):
    bar = re.search(r'<div class="bar".*?</div>', render(sources), re.DOTALL)[0]
    parts = re.findall(r'data-verdict="([^"]*)" title="(\d+)', bar)
    assert parts == [("holds", "1"), ("depends", "3")]


def test_how_many_points_miss_a_tolerance_is_counted_from_the_database(sources):
    import sqlite3

    with sqlite3.connect(sources.database) as db:
        off = db.execute(
            "select count(*) from points where max(coalesce(error_displacement, 0), "
            "coalesce(error_moment, 0), coalesce(error_tension, 0)) > 0.01"
        ).fetchone()[0]
        points, known = db.execute(
            "select count(*), sum(coalesce(error_displacement, error_moment, error_tension) is not null) "
            "from points"
        ).fetchone()
    text = " ".join(Page(render(sources)).words)
    said = (
        f"In {off} of {points} points" if off else f"At {known} grid points, the estimated errors are within"
    )
    assert said in text


@pytest.fixture(scope="module")
def claims(sources):
    with connect(sources.database) as db:
        return read_claims(db)


def test_numbers_and_claims_are_those_of_the_graded_table(claims):
    """To the last digit, in its order; the report reads the database alone."""
    rows = [*csv.DictReader(REPRODUCTION.splitlines())]
    assert len(rows) == len(claims)
    for row, graded, claim in zip(rows, ROWS, claims, strict=True):
        for name in ("paper", "id", "figure", "kind", "statement", "unit", "verdict"):
            assert getattr(claim, name) == row[name]
        for name in ("published", "simulated", "error"):
            assert getattr(claim, name) == (float(row[name]) if row[name] else None)
        share = graded.grounds.share
        assert claim.percent == (100.0 * share.met / share.samples if share else None)
        assert claim.grounds == graded.grounds


def test_bands_options_margins_and_notes_are_told_apart(claims):
    found = {claim.id: claim for claim in claims}
    assert [found[one].band for one in ("A1", "A2", "A10", "B0")] == [None, None, (73, 83), (97, 100)]
    assert found["A10"].options[0].shares == [("along, 1 m/s", 69), ("against (2)", 100)]
    assert found["A10"].sentences == ["As in A1."]
    assert found["A10"].results == [
        ("Samples that agree with the paper", "200 of 256"),
        ("Base case", "The simulated value by which the claim is judged is 3; the claim is true."),
        ("Margin of the base case", "+10 %"),
        ("Margins of 90 % of all cases", "−2 to +30 %"),
    ]
    assert found["A2"].sentences == []
    assert found["A2"].results == [
        ("Samples that agree with the paper", "256 of 256"),
        ("Base case", "The simulated value by which the claim is judged is 1.5; the claim is true."),
        ("Margin of the base case", "+25 %"),
    ]
    assert found["B0"].sentences == []
    assert found["B0"].results == [("Samples that agree with the paper", "254 of 256")]
    assert found["A10"].why == "The verdict depends on the input “the flow; U: m/s”."
    assert found["A4"].why == "No single input or pair of inputs decides the outcome."
    assert found["B0"].why == (
        "The simulation gives -3.142e+06 N; the published value is -3.142e+06 N (error 0 %)."
    )


def test_the_report_needs_no_table_but_the_database(sources, tmp_path):
    results = tmp_path / "results"
    shutil.copytree(sources.folder, results)
    for path in results.rglob("*.csv"):
        path.unlink()
    bare = Sources(sources.config, sources.papers, results / "results.sqlite", sources.compiled)
    for name, where in {"with": sources, "without": bare}.items():
        write_report(where, tmp_path / f"{name}.html")
    assert (tmp_path / "with.html").read_bytes() == (tmp_path / "without.html").read_bytes()
    assert "says this" in (tmp_path / "with.html").read_text()  # an erratum's simulation


def test_the_same_files_give_the_same_page(sources, tmp_path):
    for name in ("one.html", "two.html"):
        write_report(sources, tmp_path / name)
    assert (tmp_path / "one.html").read_bytes() == (tmp_path / "two.html").read_bytes()


def test_a_study_without_printed_numbers_has_a_page_too(sources, tmp_path):
    results = tmp_path / "results"
    shutil.copytree(sources.folder, results)
    for name in ("reproduction.csv", "errata.csv"):
        (results / name).unlink()
    bare = Sources(sources.config, sources.papers, results / "results.sqlite", sources.compiled)
    page = Page(render(built(bare)))
    assert "graded." in page.words
    assert "verdicts" not in page.anchors


def test_numbers_read_well():
    assert [share(x) for x in (0.00123, 0.5, 3.2, "", float("nan"))] == ["0.12 %", "50 %", "320 %", "", ""]
