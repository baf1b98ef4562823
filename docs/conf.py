"""How the pages become a site: `make docs`."""

from riserstudy import __version__

project = "riserstudy"
author = "riserstudy developers"
version = release = __version__
copyright = "riserstudy developers, BSD-3-Clause"  # noqa: A001  Sphinx names it so

extensions = ["myst_parser"]
myst_enable_extensions = ["dollarmath", "amsmath"]
myst_heading_anchors = 3
# Code of the pages is executed by the tests; only its colours are Sphinx's matter.
highlight_language = "none"

html_theme = "furo"
html_title = f"riserstudy {release}"
exclude_patterns = ["images"]
