"""What is said of a figure to those who do not see it."""

from matplotlib.figure import Figure

from riserstudy.figures.drawn import table, words


def test_panels_have_the_names_of_the_axes_that_they_share():
    figure = Figure()
    above, below = figure.subplots(2, 1, sharex=True)
    figure.suptitle("Heave grows")
    figure.supylabel("heave (m)")
    for ax, letter, title in ((above, "(a)", "1 m"), (below, "(b)", "3 m")):
        ax.plot([0.0, 1.0], [0.0, 2.0], label="gas law")
        ax.set_title(letter, loc="left")
        ax.set_title(title, loc="right")
    below.set_xlabel("time (s)")
    said = words(figure)
    assert said.startswith("Heave grows. 2 panels. ")
    assert "(a) 1 m: heave (m) over time (s): gas law." in said
    assert "(b) 3 m: heave (m) over time (s): gas law." in said
    first = table(figure).splitlines()[1]
    assert first.startswith("(a),time (s),heave (m),gas law,0,0")


def test_a_name_on_two_rows_is_one_name():
    figure = Figure()
    ax = figure.subplots()
    ax.plot([0.0, 1.0], [0.0, 2.0], label="secant,\nright axis")
    assert table(figure).splitlines()[1].split(",", 3)[3].startswith('"secant, right axis",0,0')
