"""The report in a real browser without a network: it moves, sorts and filters, and nothing complains."""

import base64
import itertools
import json
import shutil
from pathlib import Path

import numpy as np
import pytest
from PIL import Image
from selenium import webdriver
from selenium.webdriver.chrome.service import Service
from selenium.webdriver.common.action_chains import ActionChains
from selenium.webdriver.common.by import By
from selenium.webdriver.common.keys import Keys
from selenium.webdriver.support.ui import WebDriverWait

from riserstudy.database.build import build
from riserstudy.database.sources import Sources as Built
from riserstudy.report import write_report
from riserstudy.report.contents import Sources
from riserstudy.study.collect import dataset_of, results_of, write_dataset
from riserstudy.study.read import read_studies
from riserstudy.study.study import Study

CONFIG = Path(__file__).parents[2] / "config"
CHROMIUM, DRIVER = shutil.which("chromium"), shutil.which("chromedriver")
pytestmark = [
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
    "mao_hangoff": {
        "analysis.duration": "40 s",
        "analysis.mesh": {"elements": 40},
        "analysis.step": "0.2 s",
    },
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
            axes[name] = axis.model_copy(update={"values": [value], "preview": None})
    model = model.model_copy(update={"axes": axes, "set": model.set | RUNS[paper]})
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


@pytest.fixture(scope="module")
def page(tmp_path_factory):
    """A report of two runs and a small graded table."""
    folder = tmp_path_factory.mktemp("page")
    table, marker = folder / "reproduction.csv", folder / "compiled"
    table.write_text(REPRODUCTION)
    marker.write_text("{}")
    datasets = [simulated(paper, folder) for paper in RUNS]
    files = [*datasets, *pictures(folder), table]
    build(folder / "results.sqlite", Built(CONFIG, list(RUNS), files))
    sources = Sources(CONFIG, list(RUNS), folder / "results.sqlite", marker)
    write_report(sources, folder / "report.html")
    return folder / "report.html"


@pytest.fixture(scope="module")
def chromium(tmp_path_factory):
    """A browser without a network."""
    options = webdriver.ChromeOptions()
    options.binary_location = CHROMIUM
    for flag in (*FLAGS, f"--user-data-dir={tmp_path_factory.mktemp('chromium')}"):
        options.add_argument(flag)
    options.set_capability("goog:loggingPrefs", {"browser": "ALL", "performance": "ALL"})
    browser = webdriver.Chrome(options=options, service=Service(DRIVER))
    yield browser
    browser.quit()


@pytest.fixture
def browser(chromium, page):
    """The page, just opened, with its tables ready; at the end nothing may have complained."""
    chromium.get("about:blank")
    for log in ("performance", "browser"):
        chromium.get_log(log)
    chromium.get(page.as_uri())
    wait(chromium, lambda: chromium.find_elements(By.CSS_SELECTOR, "table.dataTable"))
    yield chromium
    # a browser that draws without graphics hardware warns that this is slow
    assert [row for row in chromium.get_log("browser") if row["level"] != "WARNING"] == []


def wait(browser, condition):
    """What a condition gives as soon as it gives something."""
    return WebDriverWait(browser, PATIENCE).until(lambda _: condition())


def drawn(browser, name):
    """A run in motion, in view and drawn."""
    place = browser.find_element(By.ID, name)
    scroll = "arguments[0].scrollIntoView({block: 'center', behavior: 'instant'})"
    browser.execute_script(scroll, place)
    wait(browser, lambda: place.get_attribute("data-ready"))
    browser.execute_script(scroll, place)  # figures above have taken their heights
    return place


def frame(browser, place):
    """The frame that the slider stands at."""
    return browser.execute_script("return arguments[0]._fullLayout.sliders[0].active", place)


def riser(browser, place):
    """x of the riser's nodes as they are drawn."""
    script = """
        const riser = arguments[0]._fullData.find((t) => t.marker?.showscale || t.line?.showscale);
        return Array.from(riser.x)"""
    return np.array(browser.execute_script(script, place))


def test_nothing_is_asked_of_a_network(browser):
    for name in (IN_PLANE, IN_SPACE):
        drawn(browser, name)
    asked = [json.loads(row["message"])["message"] for row in browser.get_log("performance")]
    addresses = [
        message["params"]["request"]["url"]
        for message in asked
        if message["method"] == "Network.requestWillBeSent"
    ]
    assert any(address.endswith("report.html") for address in addresses)
    assert {address.partition(":")[0] for address in addresses} <= {"file", "data", "blob"}


@pytest.mark.parametrize("name", [IN_PLANE, IN_SPACE])
def test_the_slider_moves_the_riser(browser, name):
    place = drawn(browser, name)
    before, picture = riser(browser, place), place.screenshot_as_png
    grip = place.find_element(By.CSS_SELECTOR, ".slider-grip-rect")
    ActionChains(browser).click_and_hold(grip).move_by_offset(300, 0).release().perform()
    wait(browser, lambda: frame(browser, place) > 5)
    wait(browser, lambda: np.abs(riser(browser, place) - before).max() > 0.1)
    assert place.screenshot_as_png != picture


def test_play_runs_and_stop_stops(browser):
    place = drawn(browser, IN_PLANE)
    play, stop = place.find_elements(By.CSS_SELECTOR, ".updatemenu-button")
    play.click()
    wait(browser, lambda: frame(browser, place) > 3)
    stop.click()
    stopped = riser(browser, place)
    ActionChains(browser).pause(0.5).perform()
    assert np.array_equal(riser(browser, place), stopped)
    assert frame(browser, place) < 100


DRAWN = """
return [...document.querySelectorAll(".enlarge canvas")].map((canvas) => canvas.width)
"""


def test_only_pictures_near_the_view_are_decoded(browser):
    figures = browser.find_elements(By.CSS_SELECTOR, "figure:has(> .enlarge)")
    last = figures[-1]
    browser.execute_script("arguments[0].scrollIntoView({behavior: 'instant'})", last)
    wait(browser, lambda: browser.execute_script(DRAWN)[-1] == 1000)
    widths = browser.execute_script(DRAWN)
    assert len(widths) == len(figures) > 10
    assert sum(width > 0 for width in widths) < 8
    assert widths[0] == 0
    assert last.find_element(By.CSS_SELECTOR, "canvas").accessible_name  # words stay


def test_a_picture_opens_in_its_full_size(browser):
    button = browser.find_elements(By.CSS_SELECTOR, "button.enlarge")[0]
    browser.execute_script(
        "arguments[0].scrollIntoView({block: 'center', behavior: 'instant'})", button
    )
    button.click()
    large = wait(browser, lambda: browser.find_element(By.CSS_SELECTOR, "dialog[open] img"))
    wait(browser, lambda: large.size["width"] == 1000)
    large.click()
    wait(browser, lambda: not browser.find_elements(By.CSS_SELECTOR, "dialog[open]"))


def test_a_picture_larger_than_the_window_is_seen_whole_and_then_in_its_full_size(browser):
    size = {"width": 800, "height": 700, "deviceScaleFactor": 1, "mobile": False}
    browser.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", size)
    try:
        button = browser.find_elements(By.CSS_SELECTOR, "button.enlarge")[0]
        browser.execute_script("arguments[0].click()", button)
        large = wait(browser, lambda: browser.find_element(By.CSS_SELECTOR, "dialog[open] img"))
        wait(browser, lambda: 700 < large.size["width"] < 800)
        large.click()
        wait(browser, lambda: large.size["width"] == 1000)
        browser.execute_script("arguments[0].click()", large)
        wait(browser, lambda: not browser.find_elements(By.CSS_SELECTOR, "dialog[open]"))
    finally:
        browser.execute_cdp_cmd("Emulation.clearDeviceMetricsOverride", {})


BOXES = """
const boxes = (of) => [...arguments[0].querySelectorAll(of)].map((e) => e.getBoundingClientRect().toJSON());
return [".slider-container", ".updatemenu-button", ".colorbar", ".draglayer .nsewdrag"].map(boxes)
"""


def apart(one, other):
    """Whether two boxes share nothing."""
    across = one["right"] <= other["left"] or other["right"] <= one["left"]
    return across or one["bottom"] <= other["top"] or other["bottom"] <= one["top"]


def test_on_a_narrow_screen_nothing_of_a_run_in_motion_lies_on_anything_else(browser):
    size = {"width": 390, "height": 1000, "deviceScaleFactor": 1, "mobile": True}
    browser.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", size)
    try:
        sliders, buttons, bars, views = browser.execute_script(BOXES, drawn(browser, IN_PLANE))
    finally:
        browser.execute_cdp_cmd("Emulation.clearDeviceMetricsOverride", {})
    assert (len(sliders), len(buttons), len(bars), len(views)) == (1, 2, 1, 4)
    parts = [*sliders, *buttons, *bars, *views]
    for one, other in itertools.combinations(parts, 2):
        assert apart(one, other), (one, other)


def test_all_pictures_are_printed(browser):
    pdf = base64.b64decode(browser.execute_cdp_cmd("Page.printToPDF", {})["data"])
    browser.execute_cdp_cmd("Emulation.setEmulatedMedia", {"media": "print"})
    try:
        images = browser.find_elements(By.CSS_SELECTOR, ".enlarge img")
        assert all(image.size["width"] > 300 for image in images)
        canvases = browser.find_elements(By.CSS_SELECTOR, ".enlarge canvas")
        assert not any(canvas.is_displayed() for canvas in canvases)
    finally:
        browser.execute_cdp_cmd("Emulation.setEmulatedMedia", {"media": ""})
    assert pdf.count(b"/Subtype /Image") + pdf.count(b"/Subtype/Image") > 0


def rows(browser, column):
    """A column of the table of numbers, as it stands."""
    cells = f"h3#numbers + .dt-container tbody td:nth-child({column})"
    return [cell.text for cell in browser.find_elements(By.CSS_SELECTOR, cells)]


def graded(browser, kind="numbers"):
    """The table of numbers, or of claims, with what belongs to it."""
    return browser.find_element(By.CSS_SELECTOR, f"h3#{kind} + .dt-container")


def test_tables_sort_by_numbers(browser):
    heading = graded(browser).find_element(By.CSS_SELECTOR, "thead th:nth-child(4)")
    assert heading.text == "Published"
    browser.execute_script(
        "arguments[0].scrollIntoView({block: 'center', behavior: 'instant'})", heading
    )
    heading.click()
    wait(browser, lambda: rows(browser, 4)[0] != "9 t")
    numbers = [float(text.split()[0]) for text in rows(browser, 4) if text]
    assert numbers == sorted(numbers) == [-2.0, 9.0, 10.0]


def test_tables_filter_by_words(browser):
    table = graded(browser)
    table.find_element(By.CSS_SELECTOR, "input[type=search]").send_keys("roll")
    wait(browser, lambda: len(table.find_elements(By.CSS_SELECTOR, "tbody tr")) == 1)
    assert "moment under roll" in table.text
    assert "1 rows of 3" in table.text


def test_a_part_of_a_bar_filters_both_tables_and_the_button_shows_all(browser):
    part = browser.find_element(By.CSS_SELECTOR, '.bars .bar a[data-verdict="reproduced"]')
    part.click()
    shown = wait(browser, lambda: browser.find_element(By.CSS_SELECTOR, ".chosen-filter span").text)
    paper = part.get_attribute("data-paper")
    assert shown == f"Shown: {paper}, reproduced."
    wait(browser, lambda: len(rows(browser, 1)) == 1)
    assert rows(browser, 1) == [paper]
    assert "reproduced" in graded(browser).text
    assert "of another kind" not in graded(browser, "claims").text
    browser.find_element(By.CSS_SELECTOR, ".chosen-filter button").click()
    wait(browser, lambda: len(rows(browser, 1)) == 3)


@pytest.mark.parametrize("width", [1440, 390])
def test_nothing_is_wider_than_the_screen(browser, width):
    size = {"width": width, "height": 900, "deviceScaleFactor": 1, "mobile": width < 500}
    browser.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", size)
    try:
        wide = browser.execute_script("return document.documentElement.scrollWidth")
        seen = browser.find_element(By.CSS_SELECTOR, "#numbers ~ .dt-container .verdict").rect
    finally:
        browser.execute_cdp_cmd("Emulation.clearDeviceMetricsOverride", {})
    assert wide <= width
    assert seen["x"] + seen["width"] <= width


WIDE = """
const button = document.querySelector("button.enlarge");
const canvas = button.querySelector("canvas");
return [canvas.getBoundingClientRect().width, button.clientWidth, button.scrollWidth];
"""


def test_on_a_narrow_screen_figures_keep_the_size_of_their_text_and_move_sideways(browser):
    size = {"width": 390, "height": 900, "deviceScaleFactor": 1, "mobile": True}
    browser.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", size)
    try:
        drawn, seen, reach = browser.execute_script(WIDE)
    finally:
        browser.execute_cdp_cmd("Emulation.clearDeviceMetricsOverride", {})
    assert drawn >= 700.0  # pixels: small letters of 8 points on 8 inches are 10 of these high
    assert seen <= 390
    assert reach >= drawn - 1.0


def test_figures_are_dark_by_night(browser):
    look = "return getComputedStyle(document.querySelector('.enlarge canvas')).filter"
    found = {}
    for scheme in ("light", "dark"):
        features = [{"name": "prefers-color-scheme", "value": scheme}]
        browser.execute_cdp_cmd("Emulation.setEmulatedMedia", {"features": features})
        found[scheme] = browser.execute_script(look)
    browser.execute_cdp_cmd("Emulation.setEmulatedMedia", {"features": []})
    assert found["light"] == "none"
    assert "invert" in found["dark"]


TOPS = """
const place = document.getElementById(arguments[0]);
return [place.getBoundingClientRect().top, document.documentElement.scrollHeight - scrollY - innerHeight]
"""
INTERNAL = """
return [...document.querySelectorAll('main a[href^="#"], nav a[href^="#"]')].map((a) => a.hash)
"""
MARGIN = 16  # that the page leaves above what a link leads to (pixels)


def stands(browser, name):
    """Where the target of a link comes to rest below the view's top, and what is left below the view."""
    seen = []

    def still():
        seen.append(browser.execute_script(TOPS, name))
        return len(seen) > 5 and all(one == seen[-1] for one in seen[-5:]) and seen[-1]

    return WebDriverWait(browser, PATIENCE, poll_frequency=0.2).until(lambda _: still())


@pytest.mark.parametrize("width", [1440, 390])
def test_links_end_where_they_lead(browser, width):
    size = {"width": width, "height": 900, "deviceScaleFactor": 1, "mobile": width < 500}
    browser.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", size)
    try:
        names = sorted({name[1:] for name in browser.execute_script(INTERNAL)})
        far = {}
        for name in [*names[:: max(1, len(names) // 8)], *reversed(names[-2:])]:
            link = f"document.querySelector('a[href=\"#{name}\"]').click()"
            browser.execute_script(link)
            far[name] = stands(browser, name)
    finally:
        browser.execute_cdp_cmd("Emulation.clearDeviceMetricsOverride", {})
    assert len(far) > 5
    far.pop("main", None)  # at the page's start there is nothing above it
    # what is nearer to the page's end than a view is high cannot be at its top
    assert {n: top for n, (top, below) in far.items() if abs(top - MARGIN) > 2 and below > 2} == {}


def test_an_address_leads_to_a_place_in_the_page(browser, page):
    last = browser.execute_script("return [...document.querySelectorAll('figure[id]')].at(-3).id")
    browser.get("about:blank")
    browser.get(f"{page.as_uri()}#{last}")
    wait(browser, lambda: browser.find_elements(By.CSS_SELECTOR, "table.dataTable"))
    top, _ = stands(browser, last)
    assert abs(top - MARGIN) <= 2


def test_verdicts_are_on_printed_paper(browser):
    pdf = base64.b64decode(browser.execute_cdp_cmd("Page.printToPDF", {})["data"])
    assert pdf.startswith(b"%PDF")
    # as printing lays the page out: an A4 sheet less its margins, in pixels of the style
    size = {"width": 703, "height": 1000, "deviceScaleFactor": 1, "mobile": False}
    browser.execute_cdp_cmd("Emulation.setEmulatedMedia", {"media": "print"})
    browser.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", size)
    try:
        cells = browser.find_elements(By.CSS_SELECTOR, "table.graded .verdict")
        ends = [cell.rect["x"] + cell.rect["width"] for cell in cells]
    finally:
        browser.execute_cdp_cmd("Emulation.clearDeviceMetricsOverride", {})
        browser.execute_cdp_cmd("Emulation.setEmulatedMedia", {"media": ""})
    assert len(ends) == 4
    assert 0 < min(ends) <= max(ends) <= 703


def test_what_is_short_is_unfolded_for_print_and_folded_again(browser):
    folded = "return document.querySelectorAll(arguments[0] + ':not([open])').length"
    long = browser.execute_script(folded, "details.long")
    assert long > 0
    browser.execute_script(
        "const p = document.createElement('details'); p.className = 'added';"
        "p.innerHTML = '<summary>s</summary>t'; document.querySelector('main').append(p);"
        "addEventListener('beforeprint', () => {"
        " window.printed = [p.open, document.querySelector('details.long').open]; });"
    )
    browser.execute_cdp_cmd("Page.printToPDF", {})
    assert browser.execute_script("return window.printed") == [True, False]
    assert browser.execute_script(folded, "details.added") == 1
    assert browser.execute_script(folded, "details.long") == long


CONTRAST = """
const light = (colour) => {
  const parts = colour.match(/[0-9.]+/g).slice(0, 3).map((x) => x / 255);
  const linear = parts.map((x) => (x <= 0.04045 ? x / 12.92 : ((x + 0.055) / 1.055) ** 2.4));
  return 0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2];
};
const behind = (element) => {
  for (let e = element; e; e = e.parentElement) {
    const colour = getComputedStyle(e).backgroundColor;
    if (!/, 0\\)$/.test(colour)) return colour;
  }
  return "rgb(255, 255, 255)";
};
return [...document.querySelectorAll(arguments[0])].map((element) => {
  const [one, other] = [light(getComputedStyle(element).color), light(behind(element))];
  return (Math.max(one, other) + 0.05) / (Math.min(one, other) + 0.05);
});
"""


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_tables_can_be_read_by_day_and_night(browser, scheme):
    features = [{"name": "prefers-color-scheme", "value": scheme}]
    browser.execute_cdp_cmd("Emulation.setEmulatedMedia", {"features": features})
    found = browser.execute_script(
        CONTRAST, "table.sortable td, table.sortable th, .dt-search input"
    )
    browser.execute_cdp_cmd("Emulation.setEmulatedMedia", {"features": []})
    assert len(found) > 10
    assert min(found) > 4.5  # what WCAG asks of text


def test_a_folded_chapter_opens_for_what_leads_into_it(browser):
    chapter = browser.find_element(By.CSS_SELECTOR, "details.chapter")
    figure = chapter.find_element(By.CSS_SELECTOR, "figure[id]").get_attribute("id")
    section = chapter.find_element(By.XPATH, "..").get_attribute("id")
    for name in (figure, section):
        browser.execute_script("arguments[0].open = false", chapter)
        link = browser.find_elements(By.CSS_SELECTOR, f'a[href="#{name}"]')
        browser.execute_script(
            "const a = arguments[0] ?? Object.assign(document.createElement('a'), {href: arguments[1]});"
            "document.querySelector('main').append(a.isConnected ? '' : a); a.click();",
            *((link[0], "") if link else (None, f"#{name}")),
        )
        wait(browser, lambda: chapter.get_property("open"))


def test_a_link_jumps_at_once(browser):
    """The place is in view before the browser draws the next frame."""
    script = """
        scrollTo(0, 0);
        const figures = document.querySelectorAll("figure[id]");
        const place = figures[figures.length - 1];
        const a = document.createElement("a");
        a.href = "#" + place.id;
        document.querySelector("main").append(a);
        a.click();
        const done = arguments[0];
        requestAnimationFrame(() => requestAnimationFrame(() => done(place.getBoundingClientRect().top)));
    """
    top = browser.execute_async_script(script)
    assert -50.0 < top < browser.execute_script("return innerHeight")


def test_enlarged_figures_have_captions_and_neighbours_and_are_worked_by_keyboard(browser):
    first = browser.find_element(By.CSS_SELECTOR, "button.enlarge")
    browser.execute_script("arguments[0].focus()", first)
    ActionChains(browser).send_keys(Keys.ENTER).perform()
    large = wait(browser, lambda: browser.find_element(By.CSS_SELECTOR, "dialog[open] img"))
    caption = browser.find_element(By.CSS_SELECTOR, "dialog .caption").text
    assert len(caption) > 10
    before = large.get_attribute("alt"), caption
    ActionChains(browser).send_keys(Keys.ARROW_RIGHT).perform()
    wait(
        browser,
        lambda: (
            (
                large.get_attribute("alt"),
                browser.find_element(By.CSS_SELECTOR, "dialog .caption").text,
            )
            != before
        ),
    )
    ActionChains(browser).send_keys(Keys.ARROW_LEFT).perform()
    wait(browser, lambda: large.get_attribute("alt") == before[0])
    ActionChains(browser).send_keys(Keys.ESCAPE).perform()
    wait(browser, lambda: not browser.find_elements(By.CSS_SELECTOR, "dialog[open]"))
