#!/bin/sh
# Run a script with the first Python that serves: $PYTHON if set, else the newest on the path, else
# one that uv has or brings, where uv is installed. Each is tried by running it, since a name on the path may be a shim with nothing behind.

supported='import sys; sys.exit(not (3, 11) <= sys.version_info[:2] <= (3, 14))'
name='import sys; print("python%d.%d-venv" % sys.version_info[:2])'

if [ -n "$PYTHON" ]; then
    set -- "$PYTHON" -- "$@"
else
    set -- python3.14 python3.13 python3.12 python3.11 python3 -- "$@"
fi

lacking=
while [ "$1" != -- ]; do
    python=$1
    shift
    said=$("$python" -c "$supported" 2>&1) || continue
    if "$python" -c 'import ensurepip, venv' 2>/dev/null; then
        while [ "$1" != -- ]; do shift; done
        shift
        exec "$python" "$@"
    fi
    lacking=$python
done

if [ -z "$PYTHON" ] && command -v uv >/dev/null; then
    shift
    # among its own, too: a name on the path with nothing behind ends the first search
    python=$(uv python find '>=3.11,<3.15' 2>/dev/null) ||
        python=$(uv python find --managed-python '>=3.11,<3.15' 2>/dev/null) || {
        echo "No Python 3.11, 3.12, 3.13 or 3.14 here: uv brings 3.13." >&2
        uv python install 3.13 && python=$(uv python find --managed-python 3.13)
    } && exec "$python" "$@"
    echo "riserstudy: uv brought no Python, see above; let it reach the network, or install your system's package of Python 3.11, 3.12, 3.13 or 3.14" >&2
    exit 1
fi
if [ -n "$lacking" ]; then
    package=$("$lacking" -c "$name")
    echo "riserstudy: $lacking has no venv module; install it (Debian, Ubuntu: apt install $package), or install uv, which brings a Python." >&2
elif [ -n "$PYTHON" ]; then
    # a shim without a version behind says itself what it lacks
    [ -x "$PYTHON" ] || command -v "$PYTHON" >/dev/null || said="no such program"
    [ -n "$said" ] && printf '%s\n' "$said" >&2
    echo "riserstudy needs Python 3.11, 3.12, 3.13 or 3.14, which PYTHON=$PYTHON is not${said:+, as it says above}; install one or name another." >&2
else
    echo "riserstudy needs Python 3.11, 3.12, 3.13 or 3.14; install uv, which brings one, or your system's package, and name it if it is off the path: make study PYTHON=/path/to/python3.12" >&2
fi
exit 1
