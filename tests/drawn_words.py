"""Words of a schematic, for tests."""

from matplotlib.text import Annotation


def labels(figure):
    """Texts beside the panels."""
    return [t for ax in figure.axes for t in ax.texts if isinstance(t, Annotation) and t.get_text()]


def words(figure):
    """All that a schematic says."""
    said = [t.get_text() for t in (*figure.texts, *labels(figure))]
    return " ".join(" ".join(said).replace("\u00a0", " ").split())
