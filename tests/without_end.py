"""Files whose reading may never end, in the place of one that a study names."""

import os
from concurrent.futures import ThreadPoolExecutor

SOON = 20.0  # s; reading any of them takes far longer, if it ends
KINDS = {
    "a pipe": os.mkfifo,
    "a link to a device": lambda path: path.symlink_to("/dev/zero"),
    "a link to a pipe": lambda path: (os.mkfifo(path.with_name("pipe")), path.symlink_to("pipe")),
    "a folder": lambda path: path.mkdir(),
}


def soon(function):
    """What a function returns or raises, within some seconds."""
    pool = ThreadPoolExecutor(1)
    try:
        return pool.submit(function).result(SOON)
    finally:
        pool.shutdown(wait=False)
