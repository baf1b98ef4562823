"""Lint the workflow by Snakemake; silent when nothing but an environment for each rule is asked for.

Rules name neither a conda environment nor a container: theirs is that of the hashed locks, in which they run.
"""

from __future__ import annotations

import re
import subprocess
import sys

LOCKED = "Specify a conda environment or container for each rule."
TITLE = re.compile(r"^    \* (.*?):?$", re.MULTILINE)


def wanted(output: str) -> list[str]:
    """Titles of the lints in what Snakemake says, without the one that the locks answer."""
    return [title for title in TITLE.findall(output) if title != LOCKED]


def main() -> int:
    """Exit status: 1 where something is asked for, or where Snakemake cannot read the workflow."""
    done = subprocess.run(["snakemake", "--lint"], capture_output=True, text=True)
    output = done.stdout + done.stderr
    answered = LOCKED in output or not done.returncode
    if wanted(output) or not answered:
        print(output)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
