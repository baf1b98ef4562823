"""Validate a crate against the profiles of run crates without a network: `python validate.py FOLDER`.

Prints every requirement that is not met. Terms come from the package `rocrate`, whose context is a later one.
"""

import json
import sys
from pathlib import Path

import rocrate
from rocrate_validator.models import Severity, ValidationSettings
from rocrate_validator.services import validate
from rocrate_validator.utils import document_loader

PROFILES = ("process-run-crate", "workflow-run-crate", "provenance-run-crate")
#: which ask for the context over the network
SKIPPED = ["ro-crate-1.1_3.1", "ro-crate-1.1_3.2"]
#: terms that 1.1 has at another address than later contexts
OF_1_1 = {name: f"https://bioschemas.org/{name}" for name in ("ComputationalWorkflow", "FormalParameter")}
TERMS = Path(rocrate.__file__).parent / "data/ro-crate.jsonld"


def offline(address):
    """The context that a crate names."""
    if "w3id.org/ro/crate" not in address:
        raise OSError(f"no network: {address}")
    found = json.loads(TERMS.read_text("utf-8"))
    found["@context"] |= OF_1_1
    return found


def main(crate):
    """Print the requirements that a crate does not meet."""
    document_loader._fetch_json_ld = offline
    for profile in PROFILES:
        settings = ValidationSettings(
            rocrate_uri=crate,
            profile_identifier=profile,
            requirement_severity=Severity.REQUIRED,
            skip_checks=SKIPPED,
        )
        for issue in validate(settings).get_issues():
            print(f"{profile}: {issue.check.identifier}: {issue.message}")
    print("validated against", ", ".join(PROFILES))


if __name__ == "__main__":
    main(sys.argv[1])
