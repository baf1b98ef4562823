"""Rules that figures keep: units, short titles, readable text."""

import re

from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.text import Text

from riserstudy.figures.figure_text import headline

PAGE = 180.0  # mm, the width of a journal's page
UNITS = "m|cm|mm|s|t|N|kN|MN|kN m|MN/m|m/s|kn|1/s|Hz|kN²/Hz|m²/Hz|kN/m|kN s²/m²|kg/m³|MPa|%|°|°/m|m/m|1/year"
#: pure numbers have no unit: a label says what is counted, or which ratio it is
PURE = r"number of |share of |ratio| / |index|factor|utilisation|ends of its range"
UNIT = re.compile(rf"\(({UNITS})\)|{PURE}")


def row_of(ax):
    """The panels beside one, of which one may say what all show."""
    if ax.get_label() == "<colorbar>":
        return [ax]
    rows = ax.get_subplotspec().rowspan
    others = [other for other in ax.figure.axes if other.get_subplotspec()]
    return [other for other in others if other.get_subplotspec().rowspan == rows]


def said_by(ax):
    """What is shown upwards; of a colour bar, along it."""
    return ax.get_ylabel() or (ax.get_label() == "<colorbar>" and ax.get_xlabel())


def assert_units(figure):
    """Every panel shows something, and every label has a unit or names a pure number."""
    labels = [figure.get_supxlabel(), figure.get_supylabel()]
    for ax in figure.axes:
        assert ax.lines or ax.patches or ax.collections
        assert figure.get_supylabel() or any(map(said_by, row_of(ax)))
        labels += [ax.get_xlabel(), ax.get_ylabel()]
    written = [label for label in labels if label]
    assert written
    for label in written:
        assert UNIT.search(label), label
    assert_numbers_named(figure)


def assert_numbers_named(figure):
    """Numbers below a panel belong to a named quantity, and so do those of its enlarged parts."""
    FigureCanvasAgg(figure).draw()
    for ax in figure.axes:
        alike = ax.get_shared_x_axes().get_siblings(ax)
        named = figure.get_supxlabel() or any(other.get_xlabel() for other in alike)
        if ax.get_label() != "<colorbar>" and not named:
            assert not numbers_below(ax), f"{headline(figure)}: x of {ax.get_title(loc='left')}"
        for part in ax.child_axes:
            if hasattr(part, "set_functions"):  # a second scale
                continue
            assert part.get_title() or (part.get_xlabel() and part.get_ylabel()), headline(figure)
            frame = ax.get_window_extent()
            for label in numbers_below(part):
                box = label.get_window_extent()
                assert frame.x0 <= box.x0, f"{headline(figure)}: {label.get_text()}"
                assert box.x1 <= frame.x1, f"{headline(figure)}: {label.get_text()}"


def numbers_below(ax):
    """Labels of the x axis that are numbers and visible."""
    low, high = sorted(ax.xaxis.get_view_interval())
    labels = [label for tick in ax.xaxis.get_major_ticks() for label in (tick.label1, tick.label2)]
    inside = [label for label in labels if label.get_visible() and low <= label.get_position()[0] <= high]
    return [label for label in inside if re.fullmatch(r"[−\d.]+", label.get_text())]


def spoken(title):
    """Words of a title without numbers, units and what is in brackets."""
    plain = re.sub(r"\([^)]*\)|\$[^$]*\$", " ", title)
    units = {"%", "°", "s", "m", "km", "mm", "t", "h", "kn", "kN", "MN", "kN m", "MPa", "m/s", "kg/m³", "×"}
    return [
        word
        for word in plain.split()
        if word not in units and not re.fullmatch(r"[-+−±]?\d[\d.,]*[°%;:,]?", word)
    ]


def assert_one_finding(figure, words=12, numbers=2):
    """A title has few words and numbers: conditions belong to panels and captions."""
    title = headline(figure)
    assert len(spoken(title)) <= words, title
    assert len(re.findall(r"(?<![\w.])\d+(?:\.\d+)?", title)) <= numbers, title


def assert_ticks_apart(figure):
    """Labels of the ticks of an axis do not overlap; the figure has been drawn."""
    for ax in figure.axes:
        for axis in (ax.xaxis, ax.yaxis):
            ticks = [tick.label1 for tick in (*axis.get_major_ticks(), *axis.get_minor_ticks())]
            low, high = sorted(axis.get_view_interval())
            inside = [
                text
                for text in ticks
                if text.get_visible() and text.get_text().strip() and low <= place(text, axis) <= high
            ]
            boxes = [(text.get_window_extent(), text.get_text()) for text in inside]
            for k, (one, name) in enumerate(boxes):
                for other, another in boxes[:k]:
                    assert not one.overlaps(other), f"{headline(figure)}: {name!r} and {another!r}"


def place(text, axis):
    """Place of the label of a tick along its axis."""
    return text.get_position()[0 if axis.axis_name == "x" else 1]


def assert_readable(figure):
    """Text is not below 6 points where a figure is as wide as a page, and tick labels are apart."""
    FigureCanvasAgg(figure).draw()
    assert_ticks_apart(figure)
    shrunk = min(1.0, PAGE / (25.4 * figure.get_size_inches()[0]))
    for text in figure.findobj(Text):
        if text.get_visible() and text.get_text().strip():
            assert shrunk * text.get_fontsize() >= 6.0, text.get_text()
