"""``python -m riserstudy.jobs.calibrate STUDY NUMBER ...``: the job ``calibrate``, by hand."""

import sys

from riserstudy.jobs.tasks import run

if __name__ == "__main__":
    sys.exit(run(["calibrate", *sys.argv[1:]]))
