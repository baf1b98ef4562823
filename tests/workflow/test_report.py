"""The report, made of the results of the workflow in small."""

import re
from html.parser import HTMLParser

import pytest

from riserstudy.report import render, write_report
from riserstudy.report.contents import Sources
from riserstudy.report.wording import grouped, seconds, share

REPRODUCTION = """\
paper,id,figure,kind,statement,published,simulated,unit,error,verdict,depends_on,note
chang2020,A1,8a,number,a <b>bold</b> number,0.3,0.538921,m,0.7964,depends,the phase,a note
chang2020,A2,8b,claim,a claim,,1.5,1,,holds,,
other2021,B1,,claim,of another,,,1,,not reproducible,,nothing said
"""
ERRATA = """\
paper,id,where,printed,reading,simulation
chang2020,E1,Eq. 3,a slip,read so,says this
"""


@pytest.fixture
def sources(finished, tmp_path):
    results = finished / "results/chang2020"
    tables = [tmp_path / "reproduction.csv", tmp_path / "errata.csv"]
    for path, text in zip(tables, (REPRODUCTION, ERRATA), strict=True):
        path.write_text(text)
    marker = tmp_path / "compiled"
    marker.write_text('{"cold_seconds": 81.5}')
    return Sources(
        config=finished / "config",
        papers=["chang2020"],
        datasets=sorted(results.glob("*.nc")),
        figures=sorted(results.glob("*.png")),
        tables=tables,
        compiled=marker,
    )


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
        if tag not in ("img", "meta", "link", "br"):
            self.open.append(tag)

    def handle_endtag(self, tag):
        assert self.open.pop() == tag

    def handle_data(self, data):
        self.words += data.split()


def test_the_page_is_whole_and_needs_no_network(sources):
    page = Page(render(sources))
    inside = [a for a in page.addresses if a.startswith("#")]
    assert {a[1:] for a in inside} <= page.anchors
    images = [a for a in page.addresses if a.startswith("data:image/png;base64,")]
    assert len(images) == len(sources.figures)
    assert len(images) + len(inside) == len(page.addresses)


def test_the_page_tells_verdicts_errata_scenes_and_times(sources):
    text = " ".join(Page(render(sources)).words)
    assert (
        "3 printed numbers and claims of 2 papers: 1 holds, 1 depends, 1 not reproducible." in text
    )
    assert "chang2020: 1 number (1 depends) and 1 claim (1 holds)." in text
    assert "a <b>bold</b> number Depends on the phase. a note 0.3 m 0.5389 m 80 %" in text
    assert "E1 Eq. 3 a slip read so says this" in text
    assert re.search(r"top.tensioners.gas.pressure 190.2 bar absolute assumed the table says", text)
    assert re.search(r"platform.heave.amplitude varied \([^)]*\) axis heave_amplitude", text)
    assert "analysis.accuracy" in text
    assert "Varied: tensioner model: gas law, linear" in text
    assert "compiling the kernels from nothing 81.5 s" in text
    summary = re.search(r'<ol class="summary">(.*?)</ol>', render(sources), re.DOTALL)[1]
    assert 5 <= summary.count("<li>") <= 10


def test_the_same_files_give_the_same_page(sources, tmp_path):
    for name in ("one.html", "two.html"):
        write_report(sources, tmp_path / name)
    assert (tmp_path / "one.html").read_bytes() == (tmp_path / "two.html").read_bytes()


def test_a_study_without_printed_numbers_has_a_page_too(sources):
    page = Page(render(Sources(**(vars(sources) | {"tables": []}))))
    assert "graded." in page.words
    assert "graded" not in page.anchors


def test_warnings_that_differ_in_numbers_alone_are_told_once_with_their_range():
    warnings = [
        "falls to -3.5e+06 N at s = 0 m: slack; see",
        "falls to -120 N at s = 0 m: slack; see",
        "other",
    ]
    assert grouped(warnings) == [
        ("falls to -3.5e+06 … -120 N at s = 0 m: slack; see", 2),
        ("other", 1),
    ]


def test_numbers_read_well():
    assert [share(x) for x in (0.00123, 0.5, 3.2, "", float("nan"))] == [
        "0.12 %",
        "50 %",
        "320 %",
        "",
        "",
    ]
    assert [seconds(x) for x in (0.0123, 3.14159, 119.0, 150.0)] == [
        "12 ms",
        "3.14 s",
        "119 s",
        "2.5 min",
    ]
