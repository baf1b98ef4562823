"""Check docs, captions, help and report page against the list of words of the style guide."""

from __future__ import annotations

import re
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
READ = (
    "README.md",
    "docs/*.md",
    "config/studies/*.yaml",
    "src/riserstudy/cli/*.py",
    "src/riserstudy/report/*.html",
)
#: pages that are generated from other texts, or are records of the past
LEFT = {"docs/changelog.md", "docs/peers_archive.md", "docs/faults.md", "docs/machines.md"}
#: words to avoid, and their replacements
WORDS = {
    r"come[s]? down on the stack": "re-contacts the BOP",
    r"run[s]? into the stops": "stroke out",
    r"lie[s]? on one another": "coincide",
    r"par(?:t|ts) by \d": "deviate by",
    r"as many as possible times": "a factor of",
    r"kept at no offset": "met at no offset",
    r"\bhangs on\b": "depends on",
    r"\bcould go\b": "removable",
    r"\bdearest\b": "most expensive",
    r"\bsimulated anew\b": "rerun",
    r"\brun anew\b": "rerun",
    r"\bof one's own\b": "your own",
    r"\basks for most\b": "requires the most",
    r"\bcalls for each\b": "includes each",
    r"\bdoes without\b": "omits",
    r"\bleft open\b": "unspecified",
    r"\bopen choices\b": "unspecified inputs",
    r"\ba panel a\b": "one panel per",
    r"\ba row a\b": "one row per",
    r"\ba line a\b": "one line per",
    r"\ba chapter a\b": "one chapter per",
    r"\bwith a jolt\b": "without a ramp",
    r"\bcomes slack\b": "loses tension",
    r"\btension setting \(-\)": "a unit",
}


def faults() -> list[str]:
    """Return every place with one of the words, and the replacement."""
    found = []
    for pattern in READ:
        for path in sorted(ROOT.glob(pattern)):
            name = path.relative_to(ROOT).as_posix()
            if name in LEFT:
                continue
            text = path.read_text("utf-8")
            for words, instead in WORDS.items():
                for match in re.finditer(words.replace(" ", r"\s+"), text, re.IGNORECASE):
                    line = text.count("\n", 0, match.start()) + 1
                    message = " ".join(match[0].split())
                    found.append(f"{name}:{line}: {message!r}: write {instead!r}")
    return found


if __name__ == "__main__":
    found = faults()
    print(*found, sep="\n")
    sys.exit(bool(found))
