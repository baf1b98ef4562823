"""How far a study is, on one line: ``snakemake --logger riserstudy`` finds this package by its name."""

from riserstudy.jobs.log_handler import LogHandler, LogHandlerSettings

__all__ = ["LogHandler", "LogHandlerSettings"]
