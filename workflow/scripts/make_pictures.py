"""Make the pictures of README and docs from scenes, from the results of `make study`, and by drawing code.

The files are small, because the repository keeps all of them.
"""

from __future__ import annotations

import re
from pathlib import Path

import xarray as xr
from matplotlib import rcParams
from matplotlib.figure import Figure
from PIL import Image

import peer_ratios
from riserstudy import load_scene
from riserstudy.figures.style import COLOURS, GREY
from riserstudy.report.motion import motion_of
from riserstudy.report.moving_riser import moving_riser
from riserstudy.schematic import COLUMNS, FLOOR, HEIGHT, WIDTH, schematic
from riserstudy.study.read import read_studies
from theory_drawings import drawings

ROOT = Path(__file__).resolve().parents[2]
IMAGES = ROOT / "docs/images"
THUMBNAIL = 520  # pixels wide: twice as wide as shown, for fine screens
PAGES = {"numerics/random_scenes": 1126}  # figures on pages, and their width (pixels)
SNAPSHOTS = ("ref_0", (10, 20, 30, 40, 50, 60))  # a run of Liu et al. (2017), and times (s)


def main() -> None:
    """Write all pictures."""
    save(overview(), IMAGES / "overview.png", dpi=110)
    rcParams["svg.hashsalt"] = "riserstudy"  # equal drawings give equal files
    for name, figure in drawings().items():
        figure.savefig(IMAGES / f"{name}.svg", metadata={"Date": None}, transparent=False)
    (IMAGES / "drive_off.svg").write_text(drive_off(), "utf-8")
    save(
        peer_ratios.drawing(peer_ratios.ratios(peer_ratios.PAGE.read_text("utf-8"))),
        peer_ratios.PICTURE,
        dpi=110,
    )
    for name in gallery():
        shrunk(name, THUMBNAIL, IMAGES / "gallery" / f"{name.replace('/', '_')}.png")
    for name, width in PAGES.items():
        shrunk(name, width, IMAGES / f"{Path(name).name}.png")


STYLE = """<style>.water{fill:#4a8fc4;opacity:.18}.bed{fill:#8a949c;opacity:.6}
.riser{fill:none;stroke:#c9503f;stroke-width:2.6;stroke-linejoin:round}
.rest{fill:none;stroke:#8a949c;stroke-dasharray:4 3}.rig{fill:#55606a}
@media (prefers-color-scheme: dark){.rig{fill:#c8d0d8}}</style>"""


def drive_off() -> str:
    """Return the animated run of Liu et al. (2017) as a small SVG that plays automatically."""
    file = read_studies(ROOT / "config", "liu2017")
    displayed = file.in_motion
    if displayed is None:
        raise LookupError("liu2017 shows no run in motion")
    with xr.open_dataset(ROOT / f"results/liu2017/{displayed.study}.nc") as data:
        caption = file.studies[displayed.study].caption
        found = moving_riser([("liu2017", motion_of(displayed, data, caption))])
    if found is None:
        raise LookupError(f"liu2017/{displayed.study}: its top does not travel over a foot that stands")
    head, _, rest = found[1].svg.partition(">")
    head = head.replace("<svg ", '<svg xmlns="http://www.w3.org/2000/svg" ')
    return f"{head}>{STYLE}{rest}\n"


def shrunk(name: str, width: int, target: Path) -> None:
    """Write a figure of the results with a width in pixels."""
    target.parent.mkdir(exist_ok=True)
    with Image.open(ROOT / f"results/{name}.png") as picture:
        height = round(picture.height * width / picture.width)
        few_colours(picture.resize((width, height), Image.Resampling.LANCZOS), target)


def gallery() -> list[str]:
    """Return the names of the gallery's figures, as `paper/figure`."""
    page = (ROOT / "docs/gallery.md").read_text("utf-8")
    return [name for part in re.findall(r"<!-- made: gallery(.*?)-->", page, re.S) for name in part.split()]


def overview() -> Figure:
    """Draw the riser of a scene to scale, and its shapes during a drive-off."""
    run, times = SNAPSHOTS
    figure = schematic(load_scene(ROOT / f"config/scenes/liu2017/{run}.yaml").resolved())
    whole, *ends = figure.axes
    for part in (*ends, *figure.texts, *figure.legends):
        part.remove()
    whole.set_title("(a) the scene, to scale", loc="left", fontsize="medium")
    left, width = (COLUMNS[1] + 0.35) / WIDTH, (WIDTH - COLUMNS[1] - 0.65) / WIDTH
    ax = figure.add_axes((left, FLOOR / HEIGHT, width, 6.0 / HEIGHT))
    with xr.open_dataset(ROOT / f"results/liu2017/{run}.nc") as data:
        rest = data.isel(time=0)
        ax.plot(rest["x"], rest["z"], "--", color=GREY, label="at rest")
        for colour, time in zip(COLOURS, times, strict=False):
            shape = data.sel(time=time)
            ax.plot(shape["x"], shape["z"], color=colour, label=f"{time} s")
        distance = float(data["x"].sel(time=times[-1])[-1] - rest["x"][-1])
    ax.set_title(
        f"(b) {distance:.0f} m away, {times[-1]} s after a drive-off began", loc="left", fontsize="medium"
    )
    ax.set(xlabel="x (m)", ylabel="elevation above the wellhead (m)")
    ax.grid(True, color="0.9", linewidth=0.6)
    ax.legend(title="shape of the riser", loc="lower right")
    return figure


def save(figure: Figure, target: Path, dpi: int) -> None:
    """Write a figure as a small PNG."""
    figure.savefig(target, dpi=dpi)
    with Image.open(target) as picture:
        few_colours(picture, target)


def few_colours(picture: Image.Image, target: Path) -> None:
    """Write a picture with a palette: a third of the file size, without a visible change of a drawing.

    The palette covers all colours of the picture, also of thin lines with few pixels. A palette by the
    median of pixels had a single colour for blue and green lines.
    """
    reduced = picture.convert("RGB").quantize(
        128, method=Image.Quantize.MAXCOVERAGE, dither=Image.Dither.NONE
    )
    reduced.save(target, optimize=True)


if __name__ == "__main__":
    main()
