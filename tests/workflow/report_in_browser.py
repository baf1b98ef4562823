"""The report in a real browser without a network: how it is made, opened and looked at."""

import shutil
from contextlib import contextmanager
from pathlib import Path

import pytest
from PIL import Image
from selenium import webdriver
from selenium.webdriver.chrome.service import Service
from selenium.webdriver.common.by import By
from selenium.webdriver.support.ui import WebDriverWait

from riserstudy.database.build import build
from riserstudy.database.sources import Sources as Built
from riserstudy.dataset.write_dataset import write_dataset
from riserstudy.report import write_report
from riserstudy.report.contents import Sources
from riserstudy.study.collect import dataset_of, results_of
from riserstudy.study.read import read_studies
from riserstudy.study.study import Study

CONFIG = Path(__file__).parents[2] / "config"
CHROMIUM, DRIVER = shutil.which("chromium"), shutil.which("chromedriver")
#: of the tests that open the report
MARKS = [
    pytest.mark.page,
    pytest.mark.skipif(not (CHROMIUM and DRIVER), reason="needs chromium and chromedriver"),
]

REPRODUCTION = """\
paper,id,figure,kind,statement,published,simulated,unit,error,verdict,depends_on,note
liu2020,N1,8a,number,tension at rest,9,8.5,t,0.06,fails,,a note
liu2020,N2,8b,number,moment under roll,10,10,kN m,0,reproduced,,
liu2020,C1,,claim,of another kind,,1,1,,holds,,
mao_hangoff,N3,9,number,displacement,-2,-2,m,0,reproduced,,
"""
#: runs in motion, in small: study, and what else it sets
RUNS = {
    "liu2020": {"analysis.duration": "40 s", "analysis.step": "0.2 s"},
    "mao_hangoff": {"analysis.duration": "40 s", "analysis.mesh": {"elements": 40}, "analysis.step": "0.2 s"},
}
PATIENCE = 180.0  # s, with a machine that does much else
IN_PLANE, IN_SPACE = "motion-liu2020", "motion-mao_hangoff"
FLAGS = (
    *("--headless", "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run"),
    *("--disable-background-networking", "--disable-component-update", "--disable-sync"),
    *("--disable-dev-shm-usage", "--enable-unsafe-swiftshader", "--window-size=1200,1000"),
    "--host-resolver-rules=MAP * ~NOTFOUND",  # no name leads anywhere
)


def simulated(paper, folder):
    """The run in motion of a paper, its axes cut down to the one point."""
    file = read_studies(CONFIG, paper)
    shown = file.in_motion
    model = file.studies[shown.study]
    axes = {}
    for name, axis in model.axes.items():
        value = shown.at[name]
        if axis == "readings":
            axes[name] = {value: file.readings[name][value]}
        else:
            axes[name] = axis.replaced(values=[value], preview=None)
    model = model.replaced(axes=axes, set=model.set | RUNS[paper])
    study = Study(paper, shown.study, model, CONFIG, "preview", "1 %", file.readings)
    results, _ = results_of(study, 1, lambda text: None)
    target = folder / paper / f"{shown.study}.nc"
    write_dataset(dataset_of(study, results), target)
    return target


def pictures(folder):
    """Grey images in place of the figures of a paper, each as high as half a screen."""
    files = []
    for name in read_studies(CONFIG, "liu2020").figures:
        path = folder / "liu2020" / name
        Image.new("RGB", (1000, 500), "grey").save(path.with_suffix(".png"))
        path.with_suffix(".pdf").write_bytes(b"%PDF")
        files += [path.with_suffix(".png"), path.with_suffix(".pdf")]
    return files


def report_in(folder):
    """A report of two runs and a small graded table."""
    table, marker = folder / "reproduction.csv", folder / "compiled"
    table.write_text(REPRODUCTION)
    marker.write_text("{}")
    datasets = [simulated(paper, folder) for paper in RUNS]
    files = [*datasets, *pictures(folder), table]
    build(folder / "results.sqlite", Built(CONFIG, list(RUNS), files))
    sources = Sources(CONFIG, list(RUNS), folder / "results.sqlite", marker)
    write_report(sources, folder / "report.html")
    return folder / "report.html"


def started(folder):
    """A browser without a network, with its profile in a folder."""
    options = webdriver.ChromeOptions()
    options.binary_location = CHROMIUM
    for flag in (*FLAGS, f"--user-data-dir={folder}"):
        options.add_argument(flag)
    options.set_capability("goog:loggingPrefs", {"browser": "ALL", "performance": "ALL"})
    return webdriver.Chrome(options=options, service=Service(DRIVER))


def open_page(browser, page):
    """Open the page; its tables are ready, and the browser has complained of nothing so far."""
    browser.get("about:blank")
    for log in ("performance", "browser"):
        browser.get_log(log)
    browser.get(page.as_uri())
    wait(browser, lambda: browser.find_elements(By.CSS_SELECTOR, "table.dataTable"))


def wait(browser, condition):
    """What a condition gives as soon as it gives something."""
    return WebDriverWait(browser, PATIENCE).until(lambda _: condition())


@contextmanager
def screen(browser, width, height):
    """A screen of another size (pixels); a narrow one is that of a telephone."""
    size = {"width": width, "height": height, "deviceScaleFactor": 1, "mobile": width < 500}
    browser.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", size)
    try:
        yield
    finally:
        browser.execute_cdp_cmd("Emulation.clearDeviceMetricsOverride", {})


@contextmanager
def media(browser, kind="", scheme=None):
    """The page as it is printed (kind ``print``), or by the colours of a scheme, ``light`` or ``dark``."""
    features = [{"name": "prefers-color-scheme", "value": scheme}] if scheme else []
    browser.execute_cdp_cmd("Emulation.setEmulatedMedia", {"media": kind, "features": features})
    try:
        yield
    finally:
        browser.execute_cdp_cmd("Emulation.setEmulatedMedia", {"media": "", "features": []})


def centre(browser, element):
    """Bring an element to the middle of the view."""
    scroll = "arguments[0].scrollIntoView({block: 'center', behavior: 'instant'})"
    browser.execute_script(scroll, element)


def drawn(browser, name):
    """A run in motion, in view and drawn."""
    place = browser.find_element(By.ID, name)
    centre(browser, place)
    wait(browser, lambda: place.get_attribute("data-ready"))
    centre(browser, place)  # figures above have taken their heights
    return place
