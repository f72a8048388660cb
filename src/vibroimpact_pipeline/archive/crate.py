"""The RO-Crate of an archive (w3id.org/ro/crate/1.1): every file, who made it, under which licence, and of what."""

import hashlib
import json
from pathlib import Path

from rocrate.model import ContextEntity
from rocrate.rocrate import ROCrate

from vibroimpact_pipeline.archive.checkout_state import State
from vibroimpact_pipeline.archive.citation import Citation
from vibroimpact_pipeline.archive.codemeta import SPDX
from vibroimpact_pipeline.archive.descriptions import Descriptions
from vibroimpact_pipeline.archive.figures import Figure

METADATA = "ro-crate-metadata.json"
WORKFLOW = "Snakefile"
CONFIG = "config/config.yaml"


def crate(
    members: dict[str, Path | bytes], state: State, cited: Citation, figures: list[Figure], said: Descriptions
) -> bytes:
    """The content of ro-crate-metadata.json.

    Args:
        members: all other files of the archive, by name.
        state: of the checkout.
        cited: what the checkout says of itself.
        figures: those of the build.
        said: what is said of files.
    """
    made = ROCrate(version="1.1")
    made.metadata.extra_terms["sha256"] = "https://schema.org/sha256"  # which the terms of RO-Crate 1.1 lack
    licence = _licence(made, cited)
    authors = _one_or_all([_entity(made, f"#author-{n}", author) for n, author in enumerate(cited.authors(), 1)])
    workflow = made.add_workflow(
        None, WORKFLOW, main=True, lang="snakemake", properties=_file(WORKFLOW, members[WORKFLOW], said)
    )
    workflow["license"], workflow["author"] = licence, authors
    files = {WORKFLOW: workflow} | {
        name: _add(made, name, source, said) for name, source in sorted(members.items()) if name != WORKFLOW
    }
    files["README.md"]["about"] = made.root_dataset
    made.root_dataset._jsonld |= _root(cited, state)
    made.root_dataset["license"], made.root_dataset["author"] = licence, authors
    made.root_dataset["isBasedOn"] = _chapter(made, cited)
    actions = [_action(made, workflow, figure, files) for figure in figures]
    made.root_dataset["mentions"] = actions
    return (json.dumps(made.metadata.generate(), indent=1, ensure_ascii=False) + "\n").encode()


def _root(cited, state):
    return {
        "name": f"{cited.project['name']} {cited.project['version']}, commit {state.commit[:12]}",
        "description": f"{cited.project['description']}. {_as_committed(state)}",
        "datePublished": str(cited.cff.get("date-released", state.date)),
        "version": cited.project["version"],
        "identifier": state.commit,
        "keywords": ", ".join(cited.project["keywords"]),
        "creativeWorkStatus": "modified" if state.modified or state.unknown else "as committed",
    }


def _as_committed(state):
    said = f"Sources of commit {state.commit}"
    if state.modified:
        said += f", but for changes in {', '.join(state.modified)}"
    if state.unknown:
        said += f"; without these files, which git does not know: {', '.join(state.unknown)}"
    return f"{said}, and what the default build made of them."


def _licence(made, cited):
    name = cited.project["license"]
    described = {"@type": "CreativeWork", "name": name, "description": f"The {name} licence.", "url": SPDX + name}
    return _entity(made, SPDX + name, described)


def _chapter(made, cited):
    chapter = cited.chapter()
    described = {"@type": "CreativeWork", "name": chapter["title"], "description": chapter["section"]}
    return _entity(made, "#chapter", described)


def _entity(made, name, properties):
    return made.add(ContextEntity(made, properties.pop("@id", name), properties=properties))


def _one_or_all(entities):
    """JSON-LD in the form that RO-Crate asks for has no lists of one."""
    return entities if len(entities) != 1 else entities[0]


def _add(made, name, source, said):
    if isinstance(source, Path) and source.is_dir():
        return made.add_dataset(None, name, properties={"name": name, "description": "A link to a folder."})
    return made.add_file(None, name, properties=_file(name, source, said))


def _file(name, source, said):
    content = source if isinstance(source, bytes) else source.read_bytes()
    return {**said.of(name), "contentSize": str(len(content)), "sha256": hashlib.sha256(content).hexdigest()}


def _action(made, workflow, figure, files):
    """How a figure was made: of which files, by which methods."""
    code = [name for step in figure.record["steps"] for name in step["files"]]
    given = dict.fromkeys([CONFIG, *figure.record["inputs"], *code])
    methods = "; ".join(f"{step['method']} ({step['digits']} digits)" for step in figure.record["steps"])
    return made.add_action(
        workflow,
        f"#{figure.name}",
        object=_one_or_all([files[name] for name in given]),
        result=[files[name] for name in [*figure.files, str(figure.path)]],
        properties={"name": f"Making of {figure.name}", "description": methods},
    )
