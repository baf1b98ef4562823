"""Tables and links of the report in a browser: they sort, filter, lead, and can be read and printed."""

import base64

import pytest
from report_in_browser import MARKS, PATIENCE, centre, media, screen, wait
from selenium.webdriver.common.by import By
from selenium.webdriver.support.ui import WebDriverWait

pytestmark = MARKS


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
    centre(browser, heading)
    heading.click()
    wait(browser, lambda: rows(browser, 4)[0] != "9 t")
    numbers = [float(text.split()[0].replace("−", "-")) for text in rows(browser, 4) if text]
    assert numbers == sorted(numbers) == [-2.0, 9.0, 10.0]


def test_tables_filter_by_words(browser):
    table = graded(browser)
    table.find_element(By.CSS_SELECTOR, "input[type=search]").send_keys("roll")
    wait(browser, lambda: len(table.find_elements(By.CSS_SELECTOR, "tbody tr")) == 1)
    assert "Moment under roll." in table.text
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
    assert "Of another kind." not in graded(browser, "claims").text
    browser.find_element(By.CSS_SELECTOR, ".chosen-filter button").click()
    wait(browser, lambda: len(rows(browser, 1)) == 3)


@pytest.mark.parametrize("width", [1440, 390])
def test_nothing_is_wider_than_the_screen(browser, width):
    with screen(browser, width, 900):
        wide = browser.execute_script("return document.documentElement.scrollWidth")
        seen = browser.find_element(By.CSS_SELECTOR, "#numbers ~ .dt-container .verdict").rect
    assert wide <= width
    assert seen["x"] + seen["width"] <= width


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
    with screen(browser, width, 900):
        names = sorted({name[1:] for name in browser.execute_script(INTERNAL)})
        far = {}
        for name in [*names[:: max(1, len(names) // 8)], *reversed(names[-2:])]:
            link = f"document.querySelector('a[href=\"#{name}\"]').click()"
            browser.execute_script(link)
            far[name] = stands(browser, name)
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


def test_verdicts_are_on_printed_paper(browser):
    pdf = base64.b64decode(browser.execute_cdp_cmd("Page.printToPDF", {})["data"])
    assert pdf.startswith(b"%PDF")
    # as printing lays the page out: an A4 sheet less its margins, in pixels of the style
    with media(browser, "print"), screen(browser, 703, 1000):
        cells = browser.find_elements(By.CSS_SELECTOR, "table.graded .verdict")
        ends = [cell.rect["x"] + cell.rect["width"] for cell in cells]
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
    text = "table.sortable td, table.sortable th, .dt-search input"
    with media(browser, scheme=scheme):
        found = browser.execute_script(CONTRAST, text)
    assert len(found) > 10
    assert min(found) > 4.5  # what WCAG asks of text


SECTIONS = """
return [...document.querySelectorAll(".contents ul ul")]
  .filter((list) => getComputedStyle(list).display !== "none")
  .map((list) => list.previousElementSibling.hash)
"""


def test_only_the_chapter_in_view_lists_its_sections_beside_the_report(browser):
    links = browser.find_elements(By.CSS_SELECTOR, ".contents > details > ul > li > ul")
    chapters = [link.find_element(By.XPATH, "preceding-sibling::a").get_attribute("hash") for link in links]
    with screen(browser, 1440, 900):
        for chapter in chapters:
            browser.execute_script("document.querySelector(arguments[0]).scrollIntoView()", chapter)
            wait(browser, lambda chapter=chapter: browser.execute_script(SECTIONS) == [chapter])
    with screen(browser, 390, 844):
        assert browser.execute_script(SECTIONS) == chapters
