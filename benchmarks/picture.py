"""Error against time of all codes, displacement beside moment, as ``s2c`` measured them."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from matplotlib.figure import Figure
from matplotlib.ticker import NullFormatter

PANELS = (("displacement_error", "displacement"), ("moment_error", "moment"))


def picture(rows: list[Any], target: Path, told: str) -> Path:
    """Draw every timed setting; a line joins those of a method and scheme, from fast to slow."""
    figure = Figure((10.0, 4.2), dpi=150, layout="constrained")
    axes = figure.subplots(1, 2, sharey=True)
    kinds = list(
        dict.fromkeys((row.method, row.scheme.split()[0] if row.scheme else "") for row in rows)
    )
    for ax, (field, word) in zip(axes, PANELS, strict=True):
        for k, kind in enumerate(kinds):
            of = [
                (row.wall_min, getattr(row, field))
                for row in rows
                if (row.method, row.scheme.split()[0] if row.scheme else "") == kind
                and row.wall_min
                and getattr(row, field)
            ]
            if of:
                ax.loglog(
                    *zip(*sorted(of), strict=True),
                    "os^Dv<>P"[k % 8] + "-",
                    ms=4,
                    label=" ".join(kind),
                )
        ax.set_xlabel("smallest wall time (s)")
        ax.set_title(f"S2c: {word}", fontsize="medium")
        ax.xaxis.set_minor_formatter(NullFormatter())
        ax.grid(alpha=0.3)
    axes[0].set_ylabel("largest error (-)")
    figure.legend(
        *axes[0].get_legend_handles_labels(), loc="outside lower center", ncols=4, fontsize="small"
    )
    figure.suptitle(told, fontsize="x-small", x=0.01, ha="left")
    figure.savefig(target)
    return target
