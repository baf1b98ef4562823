"""How the pages become a site: `make docs`."""

import sys
from pathlib import Path

from riserstudy import __version__

sys.path.insert(0, str(Path(__file__).parent / "_extensions"))

project = "riserstudy"
author = "riserstudy developers"
version = release = __version__
copyright = "riserstudy developers, BSD-3-Clause"  # noqa: A001  Sphinx names it so

extensions = [
    "myst_parser",
    "sphinx.ext.autodoc",
    "sphinx.ext.napoleon",
    "mathml",  # these three stand in _extensions
    "made_pages",
    "notebooks",
]
myst_enable_extensions = ["amsmath", "colon_fence", "dollarmath"]
myst_heading_anchors = 3
html_math_renderer = "mathml"
napoleon_google_docstring = False
autodoc_typehints = "none"  # the docstrings say what an argument is
# Untagged blocks are transcripts of a terminal, which no highlighter knows.
highlight_language = "none"

html_theme = "furo"
html_title = f"riserstudy {release}"
html_static_path = ["_static"]
html_css_files = ["site.css"]
html_js_files = ["copy.js"]
html_copy_source = False
exclude_patterns = ["images", "_extensions"]
