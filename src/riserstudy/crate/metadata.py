"""ro-crate-metadata.json: the workflow, its inputs and outputs, one action, one step per rule, claims."""

from __future__ import annotations

import json
import os
from collections.abc import Iterable, Mapping
from concurrent.futures import ThreadPoolExecutor
from contextlib import chdir
from pathlib import Path

from riserstudy.crate.claims import claim_entities
from riserstudy.crate.entities import Entity, file_entity, licence, ref, software
from riserstudy.crate.records import Made, recorded
from riserstudy.files.digests import dependencies
from riserstudy.files.seals import sealed
from riserstudy.files.whole import write_whole
from riserstudy.folders import PACKAGE

NAME = "ro-crate-metadata.json"
RUN, WORKFLOW_LANGUAGE = "#run", "https://w3id.org/workflowhub/workflow-ro-crate#snakemake"
PROFILES = {
    "https://w3id.org/ro/wfrun/process/0.5": "Process Run Crate",
    "https://w3id.org/ro/wfrun/workflow/0.5": "Workflow Run Crate",
    "https://w3id.org/ro/wfrun/provenance/0.5": "Provenance Run Crate",
    "https://w3id.org/workflowhub/workflow-ro-crate/1.0": "Workflow RO-Crate",
}
CONTEXT = "https://w3id.org/ro/crate/1.1/context"
ABOUT = (
    "Datasets, figures, graded claims and a report, with the inputs that they are made from. "
    "Files that a rerun found up to date keep the times of the run that made them."
)
#: inputs of a study in its folder; generated schemas, which only editors use, are left out
INPUTS = ("config", "chapters", "profiles", "workflow")
LOCKS = ("requirements.lock", "build.lock", "installer.lock", "pyproject.toml")
NO_INPUT = ("schemas", "__pycache__")


def inputs_of(study: Path) -> list[Path]:
    """Return the input files of a study, without its Snakefile and installed packages."""
    found = [
        path
        for folder in INPUTS
        for path in sorted((study / folder).rglob("*"))
        if path.is_file() and not {*path.relative_to(study).parts} & {*NO_INPUT}
    ]
    locks = [study / name for name in LOCKS if (study / name).exists()]
    return [*found, *_imported_by_chapters(study), *locks]


def _imported_by_chapters(study: Path) -> list[Path]:
    """Return the files of a study outside its chapters that these import, or that imported modules name."""
    with chdir(study):  # where chapters find them
        paths = sorted(Path("chapters").rglob("*.py"))
        modules = [".".join(path.with_suffix("").parts) for path in paths]
        files = frozenset[Path]().union(*map(dependencies, modules))
        names = [path.relative_to(Path.cwd()) for path in files if path.is_relative_to(Path.cwd())]
        own = [name for name in names if not name.absolute().is_relative_to(PACKAGE)]
    return [study / name for name in sorted(own) if name.parts[0] not in INPUTS]


def outputs_of(study: Path) -> list[str]:
    """Return the files that jobs of a study have made and sealed, as paths relative to its folder."""
    files = sorted(sealed(study / "results"))
    return [file.relative_to(study).as_posix() for file in files if file.is_file()]


def write_crate(study: Path) -> Path | None:
    """Write the description of a study's results into their folder.

    ``study``: folder of the study, with config and results.

    Returns
    -------
    The file that was written; None if no job has left a record, or the description is up to date.
    """
    target, outputs = study / "results" / NAME, outputs_of(study)
    if not outputs or _is_new(target, [study / name for name in outputs]):
        return None
    text = crate_text(study, study / "results")
    if text is not None:
        write_whole(target, text.encode())
    return target if text is not None else None


def crate_text(study: Path, root: Path) -> str | None:
    """Return the description of a study as JSON-LD; None if no job has left a record.

    ``root``: root of the crate: the folder of the study, or of its results.
    """
    outputs, made = outputs_of(study), recorded(study)
    known = {name: made[name] for name in outputs if name in made}
    if not known:
        return None
    content = {"@context": CONTEXT, "@graph": _graph(study, root, outputs, known)}
    return json.dumps(content, indent=1, ensure_ascii=False)


def _is_new(target: Path, files: Iterable[Path]) -> bool:
    """Return whether a file is newer than all others, which means that nothing was made since."""
    return target.exists() and target.stat().st_mtime >= max(f.stat().st_mtime for f in files)


def _graph(study: Path, root: Path, outputs: list[str], made: Mapping[str, Made]) -> list[Entity]:
    paths = [*inputs_of(study), *(study / name for name in outputs)]
    with ThreadPoolExecutor() as pool:  # hashing does not block other threads
        files = [*pool.map(file_entity, paths, [_name(path, root) for path in paths])]
    count = len(paths) - len(outputs)
    ids = [entity["@id"] for entity in files]
    by_output = dict(zip(outputs, ids[count:], strict=True))
    flow = file_entity(study / "Snakefile", _name(study / "Snakefile", root))
    steps = _steps(made, by_output)
    rules = [*dict.fromkeys(job.rule for job in made.values())]
    flow |= {
        "@type": ["File", "SoftwareSourceCode", "ComputationalWorkflow", "HowTo"],
        "name": "Snakemake workflow of riserstudy",
        "programmingLanguage": {"@id": WORKFLOW_LANGUAGE},
        "softwareRequirements": ref(*(entity["@id"] for entity in software())),
        "step": ref(*(f"#step-{rule}" for rule in rules)),
        "hasPart": ref(*(f"#rule-{rule}" for rule in rules)),
    }
    claims = [*claim_entities(study / "results/reproduction.csv")]
    ended = max(job.ended for job in made.values())
    run = _action(RUN, "run of the study", flow["@id"], made.values())
    run |= {"object": ref(*ids[:count]), "result": ref(*by_output.values())}
    stated, licences = licence(study)
    dataset: Entity = {
        "@id": "./",
        "@type": "Dataset",
        "name": f"Results of {_title(study)}",
        "description": ABOUT,
        "datePublished": ended.date().isoformat(),
        "license": stated,
        "conformsTo": ref(*PROFILES),
        "mainEntity": {"@id": flow["@id"]},
        "hasPart": ref(flow["@id"], *ids),
        "mentions": ref(RUN, *(e["@id"] for e in claims if e["@type"] == "ClaimReview")),
    }
    return [_descriptor(), dataset, *_profiles(), *licences, flow, *files, run, *steps, *software(), *claims]


def _name(path: Path, root: Path) -> str:
    return Path(os.path.relpath(path, root)).as_posix()


def _title(study: Path) -> str:
    from riserstudy.inputs.plain_yaml import read_yaml

    config = study / "config/config.yaml"
    papers = read_yaml(config).get("papers", []) if config.exists() else []
    return f"the studies {', '.join(papers)}" if papers else "a study"


def _descriptor() -> Entity:
    return {
        "@id": NAME,
        "@type": "CreativeWork",
        "about": {"@id": "./"},
        "conformsTo": ref(
            "https://w3id.org/ro/crate/1.1", "https://w3id.org/workflowhub/workflow-ro-crate/1.0"
        ),
    }


def _profiles() -> list[Entity]:
    profiles: list[Entity] = [
        {"@id": address, "@type": "CreativeWork", "name": name, "version": address.rsplit("/", 1)[1]}
        for address, name in PROFILES.items()
    ]
    language: Entity = {
        "@id": WORKFLOW_LANGUAGE,
        "@type": "ComputerLanguage",
        "name": "Snakemake",
        "identifier": {"@id": "https://doi.org/10.1093/bioinformatics/bts480"},
        "url": {"@id": "https://snakemake.readthedocs.io"},
    }
    return [*profiles, language]


def _steps(made: Mapping[str, Made], ids: Mapping[str, str]) -> list[Entity]:
    """Return, for each rule, a step, a tool, its jobs and their control action; and the organising action."""
    by_rule: dict[str, list[str]] = {}
    for name, job in made.items():
        by_rule.setdefault(job.rule, []).append(name)
    entities: list[Entity] = []
    for position, (rule, names) in enumerate(by_rule.items()):
        jobs = _action(f"#jobs-{rule}", f"jobs of {rule}", f"#rule-{rule}", [made[n] for n in names])
        entities += [
            {"@id": f"#rule-{rule}", "@type": "SoftwareApplication", "name": f"rule {rule}"},
            {"@id": f"#step-{rule}", "@type": "HowToStep", "position": str(position)}
            | {"workExample": {"@id": f"#rule-{rule}"}},
            jobs | {"result": ref(*(ids[name] for name in names))},
            {"@id": f"#control-{rule}", "@type": "ControlAction", "name": f"control of {rule}"}
            | {"instrument": {"@id": f"#step-{rule}"}, "object": {"@id": f"#jobs-{rule}"}},
        ]
    organised: Entity = {
        "@id": "#organisation",
        "@type": "OrganizeAction",
        "name": "Snakemake runs the jobs",
        "instrument": {"@id": "#snakemake"},
        "object": ref(*(f"#control-{rule}" for rule in by_rule)),
        "result": {"@id": RUN},
    }
    return [*entities, organised]


def _action(name: str, title: str, instrument: str, jobs: Iterable[Made]) -> Entity:
    """Return a completed action, from the first start to the last end of the given jobs."""
    every = [*jobs]
    return {
        "@id": name,
        "@type": "CreateAction",
        "name": title,
        "instrument": {"@id": instrument},
        "startTime": min(job.began for job in every).isoformat(timespec="seconds"),
        "endTime": max(job.ended for job in every).isoformat(timespec="seconds"),
        "actionStatus": {"@id": "http://schema.org/CompletedActionStatus"},
    }
