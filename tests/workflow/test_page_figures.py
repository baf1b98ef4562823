"""Figures and runs in motion of the report in a browser: they move, open, print, and fit the screen."""

import base64
import itertools
import json

import numpy as np
import pytest
from report_in_browser import IN_PLANE, IN_SPACE, MARKS, centre, drawn, media, screen, wait
from selenium.webdriver.common.action_chains import ActionChains
from selenium.webdriver.common.by import By
from selenium.webdriver.common.keys import Keys

pytestmark = MARKS


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
    centre(browser, button)
    button.click()
    large = wait(browser, lambda: browser.find_element(By.CSS_SELECTOR, "dialog[open] img"))
    wait(browser, lambda: large.size["width"] == 1000)
    large.click()
    wait(browser, lambda: not browser.find_elements(By.CSS_SELECTOR, "dialog[open]"))


def test_a_picture_larger_than_the_window_is_seen_whole_and_then_in_its_full_size(browser):
    with screen(browser, 800, 700):
        button = browser.find_elements(By.CSS_SELECTOR, "button.enlarge")[0]
        browser.execute_script("arguments[0].click()", button)
        large = wait(browser, lambda: browser.find_element(By.CSS_SELECTOR, "dialog[open] img"))
        wait(browser, lambda: 700 < large.size["width"] < 800)
        large.click()
        wait(browser, lambda: large.size["width"] == 1000)
        browser.execute_script("arguments[0].click()", large)
        wait(browser, lambda: not browser.find_elements(By.CSS_SELECTOR, "dialog[open]"))


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
            (large.get_attribute("alt"), browser.find_element(By.CSS_SELECTOR, "dialog .caption").text)
            != before
        ),
    )
    ActionChains(browser).send_keys(Keys.ARROW_LEFT).perform()
    wait(browser, lambda: large.get_attribute("alt") == before[0])
    ActionChains(browser).send_keys(Keys.ESCAPE).perform()
    wait(browser, lambda: not browser.find_elements(By.CSS_SELECTOR, "dialog[open]"))


BOXES = """
const boxes = (of) => [...arguments[0].querySelectorAll(of)].map((e) => e.getBoundingClientRect().toJSON());
return [".slider-container", ".updatemenu-button", ".colorbar", ".draglayer .nsewdrag"].map(boxes)
"""


def apart(one, other):
    """Whether two boxes share nothing."""
    across = one["right"] <= other["left"] or other["right"] <= one["left"]
    return across or one["bottom"] <= other["top"] or other["bottom"] <= one["top"]


def test_on_a_narrow_screen_nothing_of_a_run_in_motion_lies_on_anything_else(browser):
    with screen(browser, 390, 1000):
        sliders, buttons, bars, views = browser.execute_script(BOXES, drawn(browser, IN_PLANE))
    assert (len(sliders), len(buttons), len(bars), len(views)) == (1, 2, 1, 4)
    parts = [*sliders, *buttons, *bars, *views]
    for one, other in itertools.combinations(parts, 2):
        assert apart(one, other), (one, other)


def test_all_pictures_are_printed(browser):
    pdf = base64.b64decode(browser.execute_cdp_cmd("Page.printToPDF", {})["data"])
    with media(browser, "print"):
        images = browser.find_elements(By.CSS_SELECTOR, ".enlarge img")
        assert all(image.size["width"] > 300 for image in images)
        canvases = browser.find_elements(By.CSS_SELECTOR, ".enlarge canvas")
        assert not any(canvas.is_displayed() for canvas in canvases)
    assert pdf.count(b"/Subtype /Image") + pdf.count(b"/Subtype/Image") > 0


WIDE = """
const button = document.querySelector("button.enlarge");
const canvas = button.querySelector("canvas");
return [canvas.getBoundingClientRect().width, button.clientWidth, button.scrollWidth];
"""


def test_on_a_narrow_screen_figures_keep_the_size_of_their_text_and_move_sideways(browser):
    with screen(browser, 390, 900):
        drawn, seen, reach = browser.execute_script(WIDE)
    assert drawn >= 700.0  # pixels: small letters of 8 points on 8 inches are 10 of these high
    assert seen <= 390
    assert reach >= drawn - 1.0


def test_figures_are_dark_by_night(browser):
    look = "return getComputedStyle(document.querySelector('.enlarge canvas')).filter"
    found = {}
    for scheme in ("light", "dark"):
        with media(browser, scheme=scheme):
            found[scheme] = browser.execute_script(look)
    assert found["light"] == "none"
    assert "invert" in found["dark"]
