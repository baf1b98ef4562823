"""``python -m riserstudy.jobs draw ...``: hand a job to the process that has everything loaded.

Where there is none (a job on a cluster's node, a run by hand, a server that was killed), the job runs
here. Little is imported before that is known: to wait for a job of the server costs 50 ms.
"""

from __future__ import annotations

import json
import os
import runpy
import socket
import sys
from contextlib import suppress

from riserstudy.jobs import TAKEN


def main(job: str, arguments: list[str]) -> int:
    """Run a job there or here; return its exit status."""
    if address := os.environ.get("RISERSTUDY_JOBS"):
        with socket.socket(socket.AF_UNIX) as server, suppress(OSError):
            server.connect(address)
            if hand_over(server, job, arguments):
                return end_of(server, job)
    sys.argv[1:] = arguments
    runpy.run_module(f"riserstudy.jobs.{job}", run_name="__main__", alter_sys=True)
    return 0


def hand_over(server: socket.socket, job: str, arguments: list[str]) -> bool:
    """Ask for the job to be done with our streams and environment; whether the server took it."""
    asked = {"job": job, "arguments": arguments, "environ": {**os.environ}}
    socket.send_fds(server, [b"\n"], [0, 1, 2])
    server.sendall(json.dumps(asked).encode() + b"\n")
    return server.recv(1) == TAKEN


def end_of(server: socket.socket, job: str) -> int:
    """Wait for the exit status of a job that was taken."""
    text = b""
    with suppress(ConnectionError):
        text = server.recv(16)
    if not text:  # a crash, or the system's want of memory
        print(f"riserstudy: the process of {job} was killed", file=sys.stderr)
    return int(text or 1)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1], sys.argv[2:]))
