"""Output of Snakemake: the progress on one line, and failed steps with the ends of their logs.

A logger plugin: Snakemake passes log records to it from a separate thread.
"""

import shutil
import sys
import threading
from collections.abc import Iterable
from dataclasses import dataclass, field
from logging import WARNING, LogRecord
from pathlib import Path

from snakemake_interface_logger_plugins.base import LogHandlerBase
from snakemake_interface_logger_plugins.common import LogEvent
from snakemake_interface_logger_plugins.settings import LogHandlerSettingsBase

from riserstudy.jobs.progress import Progress
from riserstudy.jobs.step_times import StepName

ON_TERMINAL, IN_LOG = 1.0, 10.0  # time between updates of the progress (s)
LOG_TAIL = 25  # lines
NOTHING, AGAIN = "Nothing to be done", "Trying to restart job"


@dataclass
class LogHandlerSettings(LogHandlerSettingsBase):
    """Options of the plugin: ``--logger-riserstudy-tier``."""

    tier: str = field(
        default="standard",
        metadata={"help": "tier of the run; times are remembered separately for each tier", "env_var": False},
    )


class LogHandler(LogHandlerBase):
    """Shows the progress of a run in place of Snakemake's messages about each step."""

    writes_to_file = False
    has_filter = False
    has_formatter = False
    needs_rulegraph = False

    def __post_init__(self) -> None:
        tier = self.settings.tier if isinstance(self.settings, LogHandlerSettings) else "standard"
        self._progress = Progress(tier)
        self._steps_failed = False
        self._unexplained: list[str] = []  # errors of Snakemake while steps were at work
        self._terminal = sys.stdout.isatty()
        self._ended = threading.Event()
        self._counting = threading.RLock()  # held while the progress is read or changed
        self._showing: threading.Thread | None = None

    @property
    def writes_to_stream(self) -> bool:
        """Whether it replaces Snakemake's own output: not in a dry run, which lists each step."""
        return not self.common_settings.dryrun

    def emit(self, record: LogRecord) -> None:
        """Process a log record, and print failures. ``record``: log record with an ``event`` and its data."""
        if not self.common_settings.dryrun:
            with self._counting:
                self._process(record)

    def _process(self, record: LogRecord) -> None:
        event = getattr(record, "event", None)
        if event == LogEvent.RUN_INFO:
            self._progress.plan(record.stats)  # type: ignore[attr-defined]
            self._show()
        elif event == LogEvent.RESOURCES_INFO:
            self._progress.cores = getattr(record, "cores", None) or self._progress.cores
        elif event == LogEvent.JOB_INFO:
            self._begin(record)
        elif event == LogEvent.JOB_FINISHED:
            self._progress.end(int(record.job_id))  # type: ignore[attr-defined]
        elif event == LogEvent.PROGRESS:
            done, total = record.done, record.total  # type: ignore[attr-defined]
            self._progress.steps = f"{done} of {total} steps"
        elif event == LogEvent.JOB_ERROR:
            self._fail(record)
        elif event == LogEvent.ERROR and not self._steps_failed:
            self._unexplained.append(record.getMessage())
            if not self._progress.at_work:
                self._explain()
        elif event is None and record.msg:
            self._pass_on(record)

    def _explain(self) -> None:
        """Print the errors that are not about a failed step.

        Snakemake reports the error of a step's command just before it reports which step failed.
        """
        if self._unexplained:
            self._complain(["riserstudy: snakemake stopped:", *self._unexplained])
        self._unexplained = []

    def close(self) -> None:
        """Store the times of the steps, and end the line."""
        self._explain()
        if self._showing:
            self._ended.set()
            self._showing.join()
            self._showing = None
            if self._progress.steps:
                self._print_line(self._progress.text())
                print(end="\n" if self._terminal else "", flush=True)
            self._progress.remember()
        super().close()

    def _begin(self, record: LogRecord) -> None:
        job, rule = int(record.jobid), str(record.rule_name)  # type: ignore[attr-defined]
        name = StepName.of(rule, getattr(record, "wildcards", None))
        logs = getattr(record, "log", None) or ()
        log = next(map(Path, logs), None)
        self._progress.begin(job, name, getattr(record, "rule_msg", None) or "", log)

    def _fail(self, record: LogRecord) -> None:
        """Print which step failed, and the last lines of its logs."""
        self._steps_failed = True
        self._unexplained = []
        self._progress.fail(int(record.jobid))  # type: ignore[attr-defined]
        outputs = ", ".join(getattr(record, "output", None) or ["its output"])
        lines = [f"riserstudy: {getattr(record, 'rule_name', 'a step')} failed to make {outputs}"]
        for log in map(Path, getattr(record, "log", None) or ()):
            if log.is_file():
                tail = log.read_text(encoding="utf-8", errors="replace").splitlines()
                lines += [f"{log} ends:", *(f"    {line}" for line in tail[-LOG_TAIL:])]
        self._complain(lines)

    def _pass_on(self, record: LogRecord) -> None:
        """Print other messages: nothing to do, another try, warnings, and the log of a failed run."""
        text = record.getMessage()
        if text.startswith(NOTHING):
            print("Nothing to do: every result is up to date.", flush=True)
        elif text.startswith(AGAIN):
            self._complain(["riserstudy: the failed step starts again"])
        elif text.startswith("Complete log"):
            if self._steps_failed:
                self._complain([text])
        elif record.levelno >= WARNING and not self._steps_failed:
            self._complain([text])

    def _complain(self, lines: Iterable[str]) -> None:
        if self._terminal and self._showing:
            print(flush=True)
        print("\n".join(lines), file=sys.stderr, flush=True)

    def _show(self) -> None:
        """Start to show the progress: on a terminal on one line, in a log with a new line per change."""
        if self._showing is None:
            self._showing = threading.Thread(target=self._look, daemon=True)
            self._showing.start()

    def _look(self) -> None:
        last: tuple[object, ...] = ()
        while not self._ended.wait(ON_TERMINAL if self._terminal else IN_LOG):
            with self._counting:
                state, text = self._progress.state(), self._progress.text()
                begun = self._progress.steps or self._progress.at_work
            if begun and (self._terminal or state != last):
                self._print_line(text)
                last = state

    def _print_line(self, text: str) -> None:
        """Print a line; on a terminal it replaces the last line and is cut to the terminal's width."""
        if not self._terminal:
            print(text, flush=True)
            return
        width = shutil.get_terminal_size().columns - 1
        short = text if len(text) <= width else text[: width - 1] + "…"
        print(f"\r{short:{width}}", end="", flush=True)
