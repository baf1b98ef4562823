"""A Containerfile taken apart, and its steps run in a root of its own: as root, with mmdebstrap."""

import json
import os
import re
import shlex
import shutil
import subprocess
from pathlib import Path
from typing import NamedTuple

BASE = re.compile(r"docker\.io/library/debian:(?P<release>\w+)-slim")
#: how a system reaches its packages and the index, which an image gets from whoever builds it
HOST = ("etc/resolv.conf", "etc/hosts", "etc/pip.conf", "etc/apt", "etc/ssl/certs")
#: processes are seen in a container as here, in /proc
PROCESSES = 'mount -t proc proc "$0/proc" && exec chroot "$0" "$@"'
REACHING = re.compile(r"PIP_|SSL_|REQUESTS_CA|CURL_CA|\w+_proxy$", re.IGNORECASE)


class Step(NamedTuple):
    """An instruction: its name, flags such as --chown, and what follows."""

    name: str
    flags: dict[str, str]
    rest: str

    @property
    def words(self):
        """What follows, as words: of a JSON list or of a line."""
        return json.loads(self.rest) if self.rest.startswith("[") else shlex.split(self.rest)


def steps_of(text):
    """The instructions of a Containerfile, without comments, lines joined."""
    kept = "\n".join(line for line in text.splitlines() if not line.lstrip().startswith("#"))
    steps = []
    for line in re.sub(r"\\\n", " ", kept).splitlines():
        if not line.strip():
            continue
        name, rest = line.strip().split(maxsplit=1)
        flags = {}
        while found := re.match(r"--([\w-]+)=(\S+)\s+", rest):
            flags[found[1]], rest = found[2], rest[found.end() :]
        steps.append(Step(name.upper(), flags, rest.strip()))
    return steps


def ignored(patterns, path):
    """Whether patterns of .dockerignore leave a path out."""
    for pattern in patterns:
        anywhere = pattern.startswith("**/")
        parts = Path(path).parts if anywhere else Path(path).parts[:1]
        if pattern.removeprefix("**/") in parts:
            return True
    return False


class CleanRoot:
    """A root with the base of a Containerfile, in which its steps are run one by one."""

    def __init__(self, folder, source, patterns):
        self.folder, self.source, self.patterns = folder, source, patterns
        self.user, self.place, self.environment = "0", "/", {}

    def take(self, step):
        """Run one step."""
        own = {"FROM": self.base, "USER": self.become}
        own.get(step.name, getattr(self, step.name.lower(), None))(step)

    def run_as(self, command):
        """Run a command of a shell in the root, as the user and in the place that hold."""
        environment = {"PATH": "/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin"}
        environment |= {"HOME": "/root" if self.user == "0" else "/home/riser", "LANG": "C.UTF-8"}
        environment |= self._reaching() | self.environment
        inside = f"cd {shlex.quote(self.place)} && {command}"
        as_user = ["setpriv", f"--reuid={self.user}", f"--regid={self.user}", "--clear-groups"]
        words = ["unshare", "--mount", "/bin/sh", "-c", PROCESSES, self.folder, *as_user]
        words += ["/bin/bash", "-o", "pipefail", "-c", inside]
        done = subprocess.run([*map(str, words)], env=environment, capture_output=True, text=True)
        assert done.returncode == 0, f"{command}\n{done.stdout[-3000:]}\n{done.stderr[-3000:]}"
        return done.stdout

    def _reaching(self):
        """Variables by which this system reaches the index, with the certificates that they name.

        Installing certificates writes those of the release alone, so that they are copied before each step.
        """
        variables = {name: value for name, value in os.environ.items() if REACHING.match(name)}
        for value in variables.values():
            here, there = Path(value), self.folder / value.lstrip("/")
            if here.is_absolute() and here.is_file():
                there.parent.mkdir(parents=True, exist_ok=True)
                shutil.copy(here, there)
        return variables

    def base(self, step):
        """Make the base, of the same release, and let it reach what this system reaches."""
        release = BASE.fullmatch(step.rest)["release"]
        packages = "--include=apt,bash,util-linux"
        make = ["mmdebstrap", "--quiet", "--variant=minbase", packages, release, str(self.folder)]
        subprocess.run(make, check=True, capture_output=True)
        for name in HOST:
            here, there = Path("/") / name, self.folder / name
            if here.is_dir():
                shutil.copytree(here, there, dirs_exist_ok=True)
            elif here.exists():
                there.write_bytes(here.read_bytes())

    def shell(self, step):
        """Steps are run by that one."""
        assert step.words == ["/bin/bash", "-o", "pipefail", "-c"]

    def run(self, step):
        """Run a command."""
        self.run_as(step.rest)

    def become(self, step):
        """Be another user."""
        self.user = step.rest

    def workdir(self, step):
        """Go to another place."""
        self.place = step.rest

    def env(self, step):
        """Set a variable, by those that are set."""
        name, _, value = step.rest.partition("=")
        path = "/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin"
        self.environment[name] = value.replace("$PATH", path)

    def copy(self, step):
        """Copy what git tracks or would, but for what is left out."""
        assert step.words == [".", "."]
        listed = ["git", "ls-files", "--cached", "--others", "--exclude-standard", "-z"]
        names = subprocess.run(listed, cwd=self.source, check=True, capture_output=True, text=True)
        owner = [int(number) for number in step.flags["chown"].split(":")]
        target = self.folder / self.place.lstrip("/")
        for name in filter(None, names.stdout.split("\0")):
            if not ignored(self.patterns, name) and (self.source / name).is_file():
                (target / name).parent.mkdir(parents=True, exist_ok=True)
                shutil.copy2(self.source / name, target / name)
        for path in (target, *target.rglob("*")):
            os.lchown(path, *owner)

    def cmd(self, step):
        """What a container does is not done here."""
