"""Metadata of the software for archives, made from ``CITATION.cff`` and ``pyproject.toml``.

References
----------
CodeMeta 3.0 for ``codemeta.json``; the deposit metadata of Zenodo for ``.zenodo.json``.
"""

from __future__ import annotations

import json
import tomllib
from pathlib import Path
from typing import Any

from riserstudy.inputs.plain_yaml import read_yaml

ROOT = Path(__file__).resolve().parents[2]


def software_metadata() -> dict[Path, str]:
    """Return the contents of both files."""
    citation: dict[str, Any] = dict(read_yaml(ROOT / "CITATION.cff"))
    project = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))["project"]
    return {
        ROOT / "codemeta.json": _text(codemeta(citation, project)),
        ROOT / ".zenodo.json": _text(zenodo(citation, project)),
    }


def codemeta(citation: dict[str, Any], project: dict[str, Any]) -> dict[str, Any]:
    """Return the metadata in the vocabulary of CodeMeta."""
    systems = [one.split(" :: ")[-1] for one in project["classifiers"] if one.startswith("Operating System")]
    return {
        "@context": "https://w3id.org/codemeta/3.0",
        "type": "SoftwareSourceCode",
        "name": citation["title"],
        "description": citation["abstract"],
        "version": citation["version"],
        "license": f"https://spdx.org/licenses/{citation['license']}",
        "author": [{"type": "Organization", "name": one["name"]} for one in citation["authors"]],
        "programmingLanguage": "Python",
        "runtimePlatform": f"Python {project['requires-python']}",
        "operatingSystem": systems,
        "softwareRequirements": sorted(project["dependencies"]),
        "referencePublication": [_article(one) for one in citation["references"]],
    }


def zenodo(citation: dict[str, Any], project: dict[str, Any]) -> dict[str, Any]:
    """Return the metadata of a Zenodo deposit."""
    return {
        "title": f"{citation['title']}: {project['description'].rstrip('.')}",
        "description": citation["abstract"],
        "upload_type": "software",
        "version": citation["version"],
        "license": citation["license"],
        "creators": [{"name": one["name"]} for one in citation["authors"]],
        "related_identifiers": [
            {"identifier": one["doi"], "relation": "cites", "scheme": "doi"}
            for one in citation["references"]
            if "doi" in one
        ],
    }


def _article(one: dict[str, Any]) -> dict[str, Any]:
    """Return a paper; unknown fields are left out."""
    about: dict[str, Any] = {"type": "ScholarlyArticle", "name": one["title"]}
    people = [
        {"type": "Person", "familyName": who["family-names"], "givenName": who["given-names"]}
        for who in one["authors"]
        if "family-names" in who
    ]
    about |= {"author": people} if people else {}
    about |= {"isPartOf": one["journal"]} if "journal" in one else {}
    about |= {"datePublished": str(one["year"])} if "year" in one else {}
    return about | ({"id": f"https://doi.org/{one['doi']}"} if "doi" in one else {})


def _text(content: dict[str, Any]) -> str:
    return json.dumps(content, indent=2, ensure_ascii=False) + "\n"
