"""Python without what only POSIX has, for every process that has this on its path."""

import os
import socket
import sys

import psutil  # noqa: F401  whose part for Linux needs what is taken away

sys.modules["fcntl"] = None
for name in ("fork", "forkpty", "getloadavg", "O_NOFOLLOW", "sched_getaffinity"):
    delattr(os, name)

_pair, _unix = socket.socketpair, socket.AF_UNIX
del socket.AF_UNIX


def _socketpair(family=None, kind=socket.SOCK_STREAM, protocol=0):
    """A pair for event loops, which elsewhere are made of two connections."""
    return _pair(_unix, kind, protocol)


socket.socketpair = _socketpair
