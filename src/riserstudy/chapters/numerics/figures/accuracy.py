"""What accuracy costs: error against wall time, by method, with the best that can be had marked."""

from __future__ import annotations

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import NullFormatter

QUANTITIES = ("displacement", "moment", "tension")
MARKERS = "osD^vPX*"


def accuracy(accuracy: xr.Dataset) -> Figure:
    """Rows are scenes, columns quantities; a point is one mesh and step, the line the Pareto front."""
    scenes = list(accuracy["scene"].values)
    figure = Figure((11.0, 0.9 + 2.9 * len(scenes)), dpi=150, layout="constrained")
    axes = figure.subplots(len(scenes), 3, squeeze=False)
    for row, scene in enumerate(scenes):
        for column, quantity in enumerate(QUANTITIES):
            _panel(axes[row, column], accuracy.sel({"scene": scene}), scene, quantity)
            if row == len(scenes) - 1:
                axes[row, column].set_xlabel("wall time of a run (s)")
        axes[row, 0].set_ylabel(f"{scene}\nerror over largest value (-)")
    handles, labels = [], []
    for ax in axes.flat:
        for handle, label in zip(*ax.get_legend_handles_labels(), strict=True):
            if label not in labels:
                handles.append(handle)
                labels.append(label)
    figure.legend(handles, labels, loc="outside lower center", ncols=5, fontsize="small")
    return figure


def _panel(ax: Axes, of: xr.Dataset, scene: str, quantity: str) -> None:
    cost, error = [], []
    for k, method in enumerate(of["method"].values):
        one = of.sel({"method": method})
        x, y = one["wall_seconds"].values.ravel(), one[f"error_{quantity}"].values.ravel()
        ran = np.isfinite(x) & np.isfinite(y) & (y < 1.0) & (y > 0.0)
        if not ran.any():
            continue
        order = _order(one, quantity)
        note = f" ({order:.1f})" if np.isfinite(order) else ""
        ax.plot(x[ran], y[ran], MARKERS[k % len(MARKERS)], ms=3.5, color=f"C{k}", label=str(method))
        best = np.nanargmin(np.where(ran, y, np.nan))
        if note:
            ax.annotate(note, (x[best], y[best]), fontsize="xx-small", color=f"C{k}")
        cost.append(x[ran])
        error.append(y[ran])
    if not cost:
        ax.text(0.5, 0.5, f"no {quantity}", ha="center", transform=ax.transAxes, color="0.5")
        ax.set_axis_off()
        return
    x, y = np.concatenate(cost), np.concatenate(error)
    front = np.argsort(x)
    lowest = np.minimum.accumulate(y[front])
    ax.step(x[front], lowest, where="post", color="0.6", lw=1.0, zorder=0, label="best of all")
    ax.set_xscale("log")
    ax.set_yscale("log")
    ax.set_title(f"{scene}: {quantity}", fontsize="medium")
    ax.xaxis.set_minor_formatter(NullFormatter())
    ax.grid(alpha=0.3)


def _order(one: xr.Dataset, quantity: str) -> float:
    """Observed order in the step on the finest mesh, where three rungs still fall."""
    error = one[f"error_{quantity}"].isel(mesh_level=-1).values
    step = one["step"].isel(mesh_level=-1).values
    good = np.isfinite(error) & np.isfinite(step) & (error < 0.3)
    if good.sum() < 3:
        return float("nan")
    e, h = error[good][:3], step[good][:3]
    return float(np.polyfit(np.log(h), np.log(e), 1)[0])


def asked(accuracy: xr.Dataset) -> Figure:
    """Accuracy asked for, estimated and reached, and the time it took."""
    figure = Figure((9.6, 4.0), dpi=150, layout="constrained")
    left, right = figure.subplots(1, 2)
    scenes = list(dict.fromkeys(accuracy["request_scene"].values.tolist()))
    for k, scene in enumerate(scenes):
        of = accuracy.isel(request=np.flatnonzero(accuracy["request_scene"].values == scene))
        worst = np.nanmax([of[f"reached_{q}"].values for q in QUANTITIES], axis=0)
        told = np.nanmax([of[f"estimated_{q}"].values for q in QUANTITIES], axis=0)
        left.plot(of["requested"], worst, "o-", color=f"C{k}", ms=4, label=scene)
        left.plot(of["requested"], told, "x:", color=f"C{k}", ms=4)
        right.plot(of["requested"], of["request_seconds"], "o-", color=f"C{k}", ms=4, label=scene)
    ends = np.array([float(accuracy["requested"].min()), float(accuracy["requested"].max())])
    left.plot(ends, ends, color="0.6", lw=1.0, label="asked = reached")
    for ax, word in (
        (left, "error: reached (o), estimated (x)"),
        (right, "wall time, all refinements (s)"),
    ):
        ax.set_xscale("log")
        ax.set_yscale("log")
        ax.set_xlabel("accuracy asked for (-)")
        ax.set_ylabel(word)
        ax.grid(alpha=0.3)
    left.legend(fontsize="small")
    return figure
