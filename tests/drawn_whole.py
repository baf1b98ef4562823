"""That nothing of a figure is cut off at its edges."""

from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

EDGE = 0.01  # inches, that a line may be wide


def assert_whole(figure: Figure) -> None:
    """Draw a figure, and fail where something of it lies beyond its edges."""
    canvas = FigureCanvasAgg(figure)
    canvas.draw()
    inside = figure.get_tightbbox(canvas.get_renderer())
    width, height = figure.get_size_inches()
    assert -EDGE <= inside.x0 <= inside.x1 <= width + EDGE
    assert -EDGE <= inside.y0 <= inside.y1 <= height + EDGE
