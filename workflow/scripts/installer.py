"""Install locked packages with uv, or else with pip. Uses only the standard library.

uv installs in seconds; pip needs a minute. uv is an ordinary package of the index: ``installer.lock``
names it with its hashes, and pip installs it into the cache, not into an environment. uv does not read
pip's settings; therefore this script passes on the settings that give access to the index. If uv has
no wheel for the platform, or if it fails, pip installs the locks instead.

``python installer.py LOCK ...`` installs locks into the environment of the Python that runs it.
"""

import ast
import hashlib
import os
import re
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Callable
from contextlib import suppress
from functools import cache
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
UV_LOCK = ROOT / "installer.lock"
UV_CACHE = ROOT / ".cache" / "installer"
LOCKED = ("--require-hashes", "--no-build-isolation")
#: a dependency of Snakemake that has no wheel for Python 3.14 yet, and works without its compiled part
PURE = "immutables"
PURE_FROM = (3, 14)
REASON = 500  # characters of the error output of a failed program
Command = tuple[object, ...]


def install_lock(python: Path, lock: Path) -> None:
    """Install the packages of a lock, with hashes checked, in the environment of a Python of this version."""
    if sys.version_info >= PURE_FROM and (block := block_of(PURE, lock.read_text("utf-8"))):
        install_pure(python, block)
    install(python, *LOCKED, "-r", lock)


def install_pure(python: Path, block: str) -> None:
    """Install a package without its compiled part: a command that does nothing replaces the compiler.

    Neither installer may keep this wheel for other environments of the user.
    """
    with tempfile.TemporaryDirectory() as folder:
        lock = Path(folder) / "pure.lock"
        lock.write_text(block, "utf-8")
        words = (*LOCKED, "--no-deps", "--no-cache-dir", "-r", lock)
        install(python, *words, env=os.environ | {"CC": "true"})


def block_of(package: str, lock: str) -> str:
    """Return the lines of a lock that pin a package; "" if there are none."""
    found = re.search(rf"^{re.escape(package)}==.*(\n .*)*\n?", lock, re.MULTILINE)
    return found[0] if found else ""


def install(python: Path, *words: object, env: dict[str, str] | None = None) -> None:
    """Install with options that both installers know, without output unless the installation fails.

    Raises
    ------
    subprocess.CalledProcessError
        When pip fails, too.
    """
    env = dict(env or os.environ)
    if (uv := uv_for(python)) and uv_installs(uv, python, words, env):
        return
    run(*pip_of(python), "-qq", "install", "--no-input", *words, env=env)


def uv_installs(uv: Path, python: Path, words: Command, env: dict[str, str]) -> bool:
    """Return whether uv could install; if not, print the reason."""
    settings = pip_settings(python)
    options = ["--no-index"] if agreed(settings.get("no-index", "")) else []
    command = (uv, "pip", "install", "--quiet", "--python", python, *options, *words)
    return succeeds(command, with_settings(env, settings), "uv could not install")


def uv_for(python: Path) -> Path | None:
    """Return the locked uv, which pip downloads if it is missing; if pip cannot, print why, return None."""
    folder = UV_CACHE / hashlib.sha256(UV_LOCK.read_bytes()).hexdigest()[:12]
    uv = folder / "bin" / "uv"
    if uv.exists():
        return uv
    shutil.rmtree(UV_CACHE, ignore_errors=True)
    with suppress(OSError):
        UV_CACHE.mkdir(mode=0o700, parents=True)
    whole = ("--only-binary=:all:", "--no-deps", "--no-compile", "--require-hashes")
    command = (*pip_of(python), "-qq", "install", "--no-input", *whole)
    part = folder.with_name("part")
    command = (*command, "--target", part, "-r", UV_LOCK)
    if not succeeds(command, dict(os.environ), "uv was not found"):
        return None
    part.rename(folder)
    return uv


def succeeds(command: Command, env: dict[str, str], lacking: str) -> bool:
    """Return whether a command could be run and succeeded; if not, print the reason."""
    words = [str(word) for word in command]
    try:
        done = subprocess.run(words, env=env, capture_output=True, text=True, errors="replace")
    except OSError as error:
        output, failed = str(error), True
    else:
        output, failed = done.stderr, done.returncode != 0
    if failed:
        why = " ".join(output.split())[:REASON]
        print(f"riserstudy: {lacking}, so pip installs (a minute longer): {why}", file=sys.stderr)
    return not failed


def pip_of(python: Path) -> Command:
    """Return the command that runs the environment's pip."""
    return (python, "-m", "pip", "--disable-pip-version-check")


def run(*command: object, env: dict[str, str] | None = None) -> None:
    """Run a command; raise an exception if it fails."""
    subprocess.run([str(word) for word in command], check=True, env=env)


# Settings that give access to the index


@cache
def pip_settings(python: Path) -> dict[str, str]:
    """Return the options of ``pip install`` that this user has set, in files or in the environment."""
    command = [*map(str, pip_of(python)), "config", "list"]
    reported = subprocess.run(command, capture_output=True, text=True, errors="replace").stdout
    found = re.findall(r"^(global|install|:env:)\.([\w-]+)=(.*)$", reported, re.MULTILINE)
    settings: dict[str, str] = {}
    for place in ("global", "install", ":env:"):  # later ones have priority
        settings |= {name: literal(value) for where, name, value in found if where == place}
    return settings


def literal(text: str) -> str:
    """Return a value without the quotes that pip prints around it."""
    with suppress(ValueError, SyntaxError):
        return str(ast.literal_eval(text))
    return text


def agreed(text: str) -> bool:
    """Return whether an option is switched on."""
    return text.lower() in ("1", "true", "yes", "on", "y", "t")


def listed(separator: str) -> Callable[[str], str]:
    """Return a function that replaces the blanks between values of pip with a separator."""
    return lambda value: separator.join(value.split())


def same(value: str) -> str:
    """Return a single value unchanged."""
    return value


#: options of pip, and the environment variables of uv with equal meaning
HANDED_OVER: dict[str, tuple[tuple[str, ...], Callable[[str], str]]] = {
    "index-url": (("UV_DEFAULT_INDEX",), same),
    "extra-index-url": (("UV_INDEX",), listed(" ")),
    "find-links": (("UV_FIND_LINKS",), listed(",")),
    "trusted-host": (("UV_INSECURE_HOST",), listed(" ")),
    "cert": (("SSL_CERT_FILE",), same),
    "client-cert": (("SSL_CLIENT_CERT",), same),
    "proxy": (("HTTP_PROXY", "HTTPS_PROXY", "ALL_PROXY"), same),
    "timeout": (("UV_HTTP_TIMEOUT",), same),
    "default-timeout": (("UV_HTTP_TIMEOUT",), same),
    "retries": (("UV_HTTP_RETRIES",), same),
    "no-cache-dir": (("UV_NO_CACHE",), same),
}


def with_settings(env: dict[str, str], settings: dict[str, str]) -> dict[str, str]:
    """Return an environment in which uv uses pip's index; existing variables of uv have priority."""
    # Any index may provide a locked file: its hash is checked.
    found = {"UV_INDEX_STRATEGY": "unsafe-best-match"}
    for option, (names, of) in HANDED_OVER.items():
        if option in settings:
            found |= dict.fromkeys(names, of(settings[option]))
    for bundle in ("CURL_CA_BUNDLE", "REQUESTS_CA_BUNDLE"):  # pip prefers them, uv ignores them
        if env.get(bundle):
            found["SSL_CERT_FILE"] = env[bundle]
    if "SSL_CERT_FILE" not in found | env:
        found["UV_SYSTEM_CERTS"] = "true"  # pip trusts the system's certificates
    return env | {
        name: value for name, value in found.items() if not (name.startswith("UV_") and name in env)
    }


if __name__ == "__main__":
    for name in sys.argv[1:]:
        install_lock(Path(sys.executable), Path(name))
