"""Lint the workflow with Snakemake; silent if the only complaint is the missing environment of each rule.

Rules name neither a conda environment nor a container, because they run in the environment of the hashed
locks.
"""

from __future__ import annotations

import re
import subprocess
import sys

LOCKED = "Specify a conda environment or container for each rule."
TITLE = re.compile(r"^    \* (.*?):?$", re.MULTILINE)


def wanted(output: str) -> list[str]:
    """Return the titles of Snakemake's lints, except the lint about environments."""
    return [title for title in TITLE.findall(output) if title != LOCKED]


def main() -> int:
    """Return the exit status: 1 if there is a lint, or Snakemake cannot read the workflow."""
    done = subprocess.run(["snakemake", "--lint"], capture_output=True, text=True)
    output = done.stdout + done.stderr
    answered = LOCKED in output or not done.returncode
    if wanted(output) or not answered:
        print(output)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
