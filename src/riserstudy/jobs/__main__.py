"""``python -m riserstudy.jobs draw ...``: hand a job to the process that has everything loaded.

Where there is none (a job on a cluster's node, a run by hand), the job runs here. Little is imported
before that is known: to wait for a job of the server costs 50 ms.
"""

from __future__ import annotations

import json
import os
import runpy
import socket
import sys
from contextlib import suppress


def main(job: str, arguments: list[str]) -> int:
    """Run a job there or here; return its exit status."""
    if address := os.environ.get("RISERSTUDY_JOBS"):
        with socket.socket(socket.AF_UNIX) as server:
            try:
                server.connect(address)
            except OSError:
                pass  # there is no server: the job runs here
            else:
                return hand_over(server, job, arguments)
    sys.argv[1:] = arguments
    runpy.run_module(f"riserstudy.jobs.{job}", run_name="__main__", alter_sys=True)
    return 0


def hand_over(server: socket.socket, job: str, arguments: list[str]) -> int:
    """Have the server run the job with our streams and environment; wait for its exit status."""
    asked = {"job": job, "arguments": arguments, "environ": {**os.environ}}
    told = b""
    with suppress(ConnectionError):
        socket.send_fds(server, [b"\n"], [0, 1, 2])
        server.sendall(json.dumps(asked).encode() + b"\n")
        told = server.recv(16)
    if not told:  # a crash, or the system's want of memory
        print(f"riserstudy: the process of {job} was killed", file=sys.stderr)
    return int(told or 1)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1], sys.argv[2:]))
