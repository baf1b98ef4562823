"""Lists of ``riserstudy results``: studies, points, and the wide table of one study."""

from __future__ import annotations

import sqlite3
from typing import Any

from riserstudy.database.ask import Answer, ask
from riserstudy.database.names import quoted
from riserstudy.errors import InputError

ASIDE = ("_static_max", "_static_min", "_static", "_last", "_amplitude")  # shown only on request


def studies(db: sqlite3.Connection) -> Answer:
    """List all datasets, with their points, warnings, time and size."""
    return ask(
        db,
        "select study, studies.kind, table_name as 'table', tier, accuracy, rows,"
        " nullif(warned, 0) as warned, seconds as 'simulated (s)', bytes / 1e6 as MB"
        " from studies join files using (path)"
        " left join (select study, sum(wall_seconds) as seconds, sum(warnings <> '') as warned"
        " from points group by study) using (study) order by studies.rowid",
    )


def table_of(db: sqlite3.Connection, study: str) -> str | None:
    """Return the name of the wide table of a study, or a name that is a wide table itself; else None.

    The paper may be omitted where no other paper has a study of that name.
    """
    statement = "select table_name from studies where study = ? or table_name = ?"
    statement += " union select table_name from columns where table_name = ?"
    rows = ask(db, statement, (study, study, study)).rows
    alone = "select table_name from studies where name = ?"
    rows = rows or (named if len(named := ask(db, alone, (study,)).rows) == 1 else [])
    return str(rows[0][0]) if rows else None


def cells(
    db: sqlite3.Connection, table: str, columns: list[str] | None, where: str | None, sort: list[str]
) -> Answer:
    """Return rows of a wide table.

    Raises InputError when a column does not exist, or the condition is invalid.

    Parameters
    ----------
    columns : columns to show, in this order; None: axes and the main results.
    where : condition on the columns, in SQL.
    sort : columns to sort by; with a minus before its name, from largest to smallest.
    """
    statement = "select column_name, role from columns where table_name = ? order by position"
    known = dict(ask(db, statement, (table,)).rows)
    for option, names in (("--columns", columns or []), ("--sort", sort)):
        for name in names:
            if name.removeprefix("-") not in known:
                allowed = f"use one of {', '.join(known)}"
                raise InputError(option, "", f"the table has no column {name!r}", allowed)
    displayed = columns or [name for name, role in known.items() if _main(name, role)]
    sql = f"select {', '.join(map(quoted, displayed))} from {quoted(table)}"
    if where:
        sql += f" where ({where}\n)"  # the line break ends a comment in the condition
    if sort:
        sql += " order by " + ", ".join(map(_sorted, sort))
    if not where:
        return ask(db, sql, where="results")
    allowed = f"write a condition on columns, with texts in single quotes; columns: {', '.join(known)}"
    return ask(db, sql, where="--where", allowed=allowed)


def _main(name: str, role: str) -> bool:
    return role == "axis" or (role == "result" and not name.endswith(ASIDE)) or name == "point"


def _sorted(name: str) -> str:
    return f"{quoted(name.removeprefix('-'))}{' desc' if name.startswith('-') else ''} nulls last"


def units(db: sqlite3.Connection, table: str) -> dict[str, str]:
    """Return the units of the columns of a wide table, for columns with a unit."""
    statement = "select column_name, unit from columns where table_name = ? and unit not in ('', '1')"
    return dict(ask(db, statement, (table,)).rows)


def points(db: sqlite3.Connection, words: list[str]) -> Answer:
    """List points that contain all given words in key, study, place, scene, engine, effects or warnings."""
    text = "key || ' ' || study || ' ' || place || ' ' || coalesce(scene, '') || ' ' || points.engine"
    text += " || ' ' || coalesce(names, '') || ' ' || warnings"
    values: list[Any] = list(words)
    return ask(
        db,
        "select key, study, place, scene, points.engine, wall_seconds as 'time (s)', names as effects"
        " from points join studies using (study) left join"
        " (select effect_set, group_concat(effect, ', ') as names from effect_sets where is_on"
        "  group by effect_set) using (effect_set)"
        f" where {' and '.join(f'instr({text}, ?) > 0' for _ in words) or 1} order by point",
        values,
    )
