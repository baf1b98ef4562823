"""A Python that the script of a cluster's job cannot start is refused before any job is submitted.

The judge is the shell: it gets the path without quotes, as Snakemake's executors for clusters write it.
"""

import random
import re
import subprocess
import sys
from pathlib import Path

import pytest

from riserstudy.errors import InputError
from riserstudy.jobs.start_server import refuse_quoted_python

PLAIN = "abcXYZ019_-.+,=@%ß河"
SPECIAL = " \t'\"$`&;|<>()*?[]#~!\\"


def link(folder, name):
    """A Python in an environment whose folder has that name."""
    place = folder / name / "bin"
    place.mkdir(parents=True)
    (place / "python").symlink_to(sys.executable)
    return str(place / "python")


def started(python):
    """Whether a shell that reads the path without quotes starts this Python."""
    command = f"{python} -c 'print(417)'"
    done = subprocess.run(["sh", "-c", command], capture_output=True, text=True, cwd=Path(python).parent)
    return (done.returncode, done.stdout) == (0, "417\n")


def refusal(python):
    """The message, or "" where there is none."""
    try:
        refuse_quoted_python(python)
    except InputError as error:
        return str(error)
    return ""


@pytest.mark.parametrize("seed", range(24))
def test_a_python_that_a_shell_does_not_start_is_refused(seed, tmp_path):
    draw = random.Random(seed)
    letters = [draw.choice(PLAIN) for _ in range(draw.randint(1, 8))]
    plain = link(tmp_path, "a" + "".join(letters))
    assert (refusal(plain), started(plain)) == ("", True)
    letters.insert(draw.randrange(len(letters)), draw.choice(SPECIAL))
    special = link(tmp_path, "b" + "".join(letters))
    assert refusal(special) or started(special)


@pytest.mark.parametrize("name", ["mein Riser", "it's", "a 'b' & c"])
def test_the_link_of_the_message_leads_to_a_python_that_is_started(name, tmp_path):
    python = link(tmp_path, name)
    message = refusal(python)
    assert python in message
    command = re.search(r"`(ln -s .*?)`", message)[1]
    subprocess.run(["sh", "-c", command], check=True, env={"HOME": str(tmp_path), "PATH": "/usr/bin:/bin"})
    through = str(tmp_path / "riserstudy-environment/bin/python")
    assert not started(python)
    assert (refusal(through), started(through)) == ("", True)
