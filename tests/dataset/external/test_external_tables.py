"""Tables as programs and spreadsheets write them: read as they are meant, or refused with line and remedy."""

import string

import numpy as np
import pytest
import xarray as xr

from riserstudy.dataset.comparison import compared, difference
from riserstudy.dataset.external.text import read_table
from riserstudy.errors import InputError

TIME, S = np.arange(0.0, 60.0, 0.5), np.array([0.0, 100.0, 200.0])


def swing(time, place):
    """In kN."""
    return 1e3 + place + 50.0 * np.sin(0.6 * time)


def run():
    tension = 1e3 * swing(TIME[:, None], S[None, :])
    data = {
        "effective_tension": (("time", "s"), tension, {"units": "N"}),
        "ufj_angle": ("time", np.radians(2.0) * np.cos(TIME), {"units": "rad"}),
    }
    return xr.Dataset(data, {"time": TIME, "s": S}, {"title": "a run"})


def cells(rng, decimal):
    """Numbers as text, in one of the ways that programs write them."""
    form = str(rng.choice(["{:.6f}", "{:.8e}", "{:.10g}"]))
    return lambda value: form.format(value).replace(".", decimal)


def spelled(rng, unit):
    left, right = [("(", ")"), ("[", "]")][rng.integers(2)]
    return f"{left}{unit}{right}"


@pytest.mark.parametrize("seed", range(40))
def test_one_table_in_any_spelling_is_one_table(tmp_path, seed):
    """Marks between cells and of decimals, byte order mark, line ends, titles, units below, quotes."""
    rng = np.random.default_rng(seed)
    mark = str(rng.choice([",", ";", "\t"]))
    decimal = "," if mark != "," and rng.random() < 0.5 else "."
    text = cells(rng, decimal)
    names = ["time", "effective_tension at 100 m"]
    units = [spelled(rng, "s"), spelled(rng, "kN")]
    rows = []
    if rng.random() < 0.5:
        rows += [["Results of a run"], [], ["made by a program", "version 11"]]
    rows += (
        [names, units] if rng.random() < 0.5 else [[f"{n} {u}" for n, u in zip(names, units, strict=True)]]
    )
    rows += [[text(t), text(swing(t, 100.0))] for t in TIME]
    tail = [""] if rng.random() < 0.5 else []
    pad = " " if rng.random() < 0.5 and mark != "\t" else ""
    quote = '"{}"'.format if rng.random() < 0.3 else "{}".format
    ends = str(rng.choice(["\n", "\r\n"]))
    lines = [(mark + pad).join([*map(quote, row), *tail]) if pad == "" else
             (mark + pad).join([*row, *tail]) for row in rows]  # fmt: skip
    path = tmp_path / "other.csv"
    start = b"\xef\xbb\xbf" if rng.random() < 0.5 else b""
    path.write_bytes(start + (ends.join(lines) + ends * int(rng.integers(3))).encode())
    found = compared(run(), path)
    (pair,) = found.pairs
    # the last digits that are written
    assert difference(pair).rms < 1.0
    assert len(pair.along) == len(TIME)
    assert any("decimal" in note for note in found.notes) == (decimal == ",")


@pytest.mark.parametrize("seed", range(10))
def test_what_is_left_out_is_counted(tmp_path, seed):
    rng = np.random.default_rng(seed)
    empty = rng.choice(len(TIME), int(rng.integers(1, 20)), replace=False)
    words = ["" if k in empty else f"{swing(t, 0.0)}" for k, t in enumerate(TIME)]
    words = ["nan" if w == "" and rng.random() < 0.5 else w for w in words]
    beyond = int(rng.integers(1, 9))
    rows = [f"{t},{w}" for t, w in zip(TIME, words, strict=True)]
    rows += [f"{TIME[-1] + k},1" for k in range(1, beyond + 1)]
    path = tmp_path / "other.csv"
    path.write_text("\n".join(["time (s),effective_tension at 0 m (kN)", *rows]))
    (pair,) = compared(run(), path).pairs
    assert f"left out: {beyond} of {len(rows)} rows, beyond the run's time from 0 to 59.5" in pair.notes
    missing = f"left out: {len(empty)} of {len(TIME)} rows, where the file has no number"
    assert missing in pair.notes
    assert len(pair.along) == len(TIME) - len(empty)
    assert difference(pair).rms < 1.0


HEAD = "time (s),effective_tension at 0 m (kN)\n"
LONG = "\n".join(f"{k},{k}" for k in range(6))


@pytest.mark.parametrize(
    "text, said",
    [
        ("", "no numbers below a line of headings"),
        (HEAD, "no numbers below a line of headings"),
        ("1,2\n3,4\n", "no numbers below a line of headings"),
        ("time (s)\n1\n2\n", "one column"),
        (HEAD + "0,1\n1,2,3\n", "line 3: the number of cells, 3, differs"),
        (HEAD + "0,1\n1\n", "line 3: the number of cells, 1, differs"),
        (HEAD + "0,1\n1,two\n", "'two' in column 'effective_tension at 0 m (kN)'"),
        (HEAD + "0,1\n1,1_000\n", "'1_000' in column"),
        (HEAD + "0,1\n1,1e999\n", "'1e999' in column"),
        (HEAD + "0,1\n1,-7e300\n", "'-7e300' in column"),
        (HEAD + "0,1\n1,\uff11\n", "in column"),
        (HEAD + "0,1\n,2\n2,3\n3,4\n4,5\n", "row 2 has no number"),
        (HEAD + "0,1\n2,2\n1,3\n3,4\n", "1 follows 2 in row 3"),
        (HEAD + "0,1\n1,2\n1,3\n3,4\n", "1 follows 1 in row 3"),
        (HEAD + "0,\n1,\n2,\n", "has no numbers"),
        ("time (s);effective_tension at 0 m (kN)\n0,5;1\n1.5;2\n", "a decimal comma, and line 3 a decimal"),
        ("time (s),ufj_angle (deg),ufj_angle (deg)\n0,1,1\n1,1,1\n", "two columns have this heading"),
        ("time (s),ufj_angle (deg),ufj_angle (rad)\n0,1,1\n1,1,1\n", "gives the same variable and place"),
        ("time (s),ufj_angle (deg),\n0,1,1\n1,1,1\n", "differs from the number of headings, 2"),
        ("time (s),,ufj_angle (deg)\n0,1,1\n1,1,1\n", "a column has no heading"),
        ("time (s),effective_tension at 1.2.3 m (kN)\n" + LONG, "is not a heading with a unit"),
        ("time (s),effective_tension at 0 m (furlong)\n" + LONG, "wrong dimension"),
        ("time (s),effective_tension at 0 m (kNN)\n" + LONG, "is not known"),
        ("time (m),effective_tension at 0 m (kN)\n" + LONG, "wrong dimension"),
        ("when (s),effective_tension at 0 m (kN)\n" + LONG, "is not an axis"),
        ("time at 3 m (s),effective_tension at 0 m (kN)\n" + LONG, "is not an axis"),
    ],
)
def test_an_external_table_that_cannot_be_meant_is_refused(tmp_path, text, said):
    path = tmp_path / "other.csv"
    path.write_text(text)
    with pytest.raises(InputError) as refused:
        compared(run(), path)
    assert said in str(refused.value)


@pytest.mark.parametrize("seed", range(60))
def test_spoiled_tables_are_read_or_refused(tmp_path, seed):
    """A table with characters put in, taken out and exchanged: never another error than a refusal."""
    rng = np.random.default_rng(seed)
    text = [*(HEAD + "\n".join(f"{t},{swing(t, 0.0):.6g}" for t in TIME[:30]))]
    signs = [*string.printable, "\x00", "\ufeff", "−", "\u2028", '"', ",", ";", "\t"]
    for _ in range(int(rng.integers(1, 12))):
        k = int(rng.integers(len(text)))
        text[k : k + int(rng.integers(3))] = [str(rng.choice(signs)) for _ in range(rng.integers(3))]
    path = tmp_path / "other.csv"
    path.write_bytes("".join(text).encode("utf-8", "surrogatepass"))
    try:
        for pair in compared(run(), path).pairs:
            off = difference(pair)
            assert np.isfinite(off.rms)
    except InputError:
        return  # as it should


def test_a_table_of_utf_16_is_refused_with_the_remedy(tmp_path):
    path = tmp_path / "other.csv"
    path.write_text(HEAD + LONG, "utf-16")
    with pytest.raises(InputError, match="save the file as UTF-8"):
        compared(run(), path)


@pytest.mark.long
def test_a_large_table_is_read(tmp_path):
    """A million values, 20 MB."""
    path = tmp_path / "other.csv"
    time = np.linspace(0.0, 59.5, 500_000)
    table = np.column_stack([time, swing(time, 0.0)])
    np.savetxt(path, table, fmt="%.10g", delimiter=",", header=HEAD.strip(), comments="")
    (pair,) = compared(run(), path).pairs
    assert len(pair.along) == len(time)
    # the run is straight between its outputs
    assert difference(pair).rms < 1e3


@pytest.mark.parametrize("unit", ["kN.m", "kN m", "kN*m", "kN·m"])
def test_a_moment_may_be_written_as_programs_do(tmp_path, unit):
    data = {"bending_moment_max": ("s_node", 1e3 * np.arange(5.0), {"units": "N m"})}
    other = xr.Dataset(data, {"s_node": np.arange(5.0)})
    path = tmp_path / "other.csv"
    path.write_text(f"s (m),bending_moment_max ({unit})\n" + "\n".join(f"{k},{k}" for k in range(5)))
    (pair,) = compared(other, path).pairs
    assert difference(pair).rms < 1e-9


def test_names_of_the_file_are_said_by_the_user(tmp_path):
    path = tmp_path / "other.csv"
    rows = "\n".join(f"{t},{swing(t, 100.0)},7" for t in TIME)
    path.write_text(f"Zeit,Te Knoten 7,Druck\n{rows}")
    called = {"Zeit": "time (s)", "Te Knoten 7": "effective_tension at 100 m (kN)"}
    found = compared(run(), path, called=called)
    assert difference(found.pairs[0]).rms < 1e-6
    assert found.notes == ["left out, as --column does not name them: Druck"]
    with pytest.raises(InputError, match="the file has no heading of this name"):
        compared(run(), path, called={"Te": "ufj_angle (deg)"})


@pytest.mark.parametrize("empty", ["time", "s"])
def test_a_run_without_values_is_refused(tmp_path, empty):
    path = tmp_path / "other.csv"
    path.write_text(HEAD + LONG)
    with pytest.raises(InputError, match="the run has no effective_tension over time"):
        compared(run().isel({empty: slice(0, 0)}), path)


def test_a_run_of_missing_values_is_refused_with_the_reason(tmp_path):
    path = tmp_path / "other.csv"
    path.write_text(HEAD + LONG)
    lost = run()
    lost["effective_tension"] = lost["effective_tension"] * np.nan
    with pytest.raises(InputError, match="where the run has no number"):
        compared(lost, path)


def test_numbers_are_those_of_the_text(tmp_path):
    path = tmp_path / "other.csv"
    path.write_text("a (m),b (m)\n-1.5e-3, .5\n+2, 1.\n")
    table = read_table(path)
    assert [*table.columns[0], *table.columns[1]] == [-1.5e-3, 2.0, 0.5, 1.0]
