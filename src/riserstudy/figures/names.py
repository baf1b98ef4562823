"""Names of outputs and limits in figures."""

from __future__ import annotations

import re

#: words with capital letters
WRITTEN = {"ufj": "UFJ", "lfj": "LFJ", "lmrp": "LMRP", "bop": "BOP", "von mises": "von Mises"}


def in_words(name: str) -> str:
    """A name of a dataset or a limit in words: ``largest ufj_angle`` becomes ``largest UFJ angle``."""
    words = name.replace("_", " ")
    for plain, written in WRITTEN.items():
        words = re.sub(rf"\b{plain}\b", written, words)
    return words
