"""Numbers and claims with their verdicts as entities of a crate."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

from riserstudy.crate.entities import Entity
from riserstudy.files.csv_files import read_csv


def claim_entities(table: Path) -> Iterator[Entity]:
    """Yield claim, review with verdict, and margin of each row of reproduction.csv; each verdict once."""
    rows = read_csv(table) if table.exists() else []
    for verdict in dict.fromkeys(row["verdict"] for row in rows):
        yield {"@id": _verdict(verdict), "@type": "Rating", "name": verdict, "ratingValue": verdict}
    for row in rows:
        name = f"{row['paper']}-{row['id']}"
        yield {
            "@id": f"#claim-{name}",
            "@type": "Claim",
            "name": f"{row['paper']} {row['id']}",
            "text": row["statement"],
        }
        review: Entity = {
            "@id": f"#review-{name}",
            "@type": "ClaimReview",
            "name": f"verdict of {row['paper']} {row['id']}",
            "itemReviewed": {"@id": f"#claim-{name}"},
            "reviewRating": {"@id": _verdict(row["verdict"])},
        }
        if row["note"]:
            review["reviewBody"] = row["note"]
        if row["margin"]:
            review["additionalProperty"] = {"@id": f"#margin-{name}"}
            yield {
                "@id": f"#margin-{name}",
                "@type": "PropertyValue",
                "name": "margin to the threshold",
                "value": float(row["margin"]),
            }
        yield review


def _verdict(name: str) -> str:
    return f"#verdict-{name.replace(' ', '-')}"
