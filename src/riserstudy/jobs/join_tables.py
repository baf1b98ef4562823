"""Join CSV tables with the same columns into one, in the order given."""

from __future__ import annotations

import argparse
from pathlib import Path

from riserstudy.folders import write_whole
from riserstudy.jobs.seals import seal


def main(target: Path, sources: list[Path]) -> None:
    """Write the first table's header and every table's rows."""
    texts = [source.read_text("utf-8") for source in sources]
    headers = {text.partition("\n")[0] for text in texts}
    if len(headers) > 1:
        raise SystemExit(f"{target}: tables with different columns cannot be joined")
    rows = "".join(text.partition("\n")[2] for text in texts)
    write_whole(target, ("".join(f"{header}\n" for header in headers) + rows).encode())
    seal(target)


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("target", type=Path)
    parser.add_argument("sources", type=Path, nargs="*")
    main(**vars(parser.parse_args()))
