"""``python -m riserstudy.jobs draw ...``: hand a job to the server process, which has all libraries loaded.

Without a server (a job on a node of a cluster, a run by hand, a server that was killed) the job runs in this
process. With ``--alone`` it does so, too: times measured in a fork would depend on what the server has loaded
by then. Little is imported before this is decided: waiting for a job of the server costs 30 ms.
"""

from __future__ import annotations

import json
import os
import socket
import sys
from contextlib import suppress

from riserstudy.jobs import TAKEN

ALONE = "--alone"


def main(arguments: list[str]) -> int:
    """Run a job in the server or in this process, and return its exit status."""
    address = os.environ.get("RISERSTUDY_JOBS")
    if arguments[:1] == [ALONE]:
        arguments = arguments[1:]
    elif address:
        with socket.socket(socket.AF_UNIX) as server, suppress(OSError):
            server.connect(address)
            if hand_over(server, arguments):
                return end_of(server, *arguments[:1])
    from riserstudy.jobs.tasks import run

    return run(arguments)


def hand_over(server: socket.socket, arguments: list[str]) -> bool:
    """Request a job with our streams and environment; return whether the server accepted it."""
    request = {"arguments": arguments, "environ": {**os.environ}}
    socket.send_fds(server, [b"\n"], [0, 1, 2])
    server.sendall(json.dumps(request).encode() + b"\n")
    return server.recv(1) == TAKEN


def end_of(server: socket.socket, job: str = "a job") -> int:
    """Wait for the exit status of a job that the server accepted."""
    text = b""
    with suppress(ConnectionError):
        text = server.recv(16)
    if not text:  # a crash, or the system had no memory left
        print(f"riserstudy: the process of {job} was killed", file=sys.stderr)
    return int(text or 1)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
