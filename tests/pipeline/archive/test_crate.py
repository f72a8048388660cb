"""A crate says whether its sources are those of its commit."""

import json

import pytest

from pipeline_trees import ROOT
from vibroimpact_pipeline.archive.checkout_state import State
from vibroimpact_pipeline.archive.citation import citation
from vibroimpact_pipeline.archive.crate import crate
from vibroimpact_pipeline.archive.descriptions import Descriptions
from vibroimpact_pipeline.data_dictionary import read

COMMIT, DATE = "0123456789abcdef" * 2 + "01234567", "2020-02-03T04:05:06+00:00"
SPECS, DATA = read(ROOT)


def root_of(modified=(), unknown=()):
    members = {name: ROOT / name for name in ("README.md", "Snakefile", "config/config.yaml", "profiles")}
    state = State(COMMIT, DATE, [*members], [*modified], [*unknown])
    said = Descriptions(SPECS, DATA)
    document = json.loads(crate(members, state, citation(ROOT), [], said))
    return next(entity for entity in document["@graph"] if entity["@id"] == "./")


def test_sources_as_committed():
    root = root_of()
    assert root["creativeWorkStatus"] == "as committed"
    assert f"Sources of commit {COMMIT}, and what the default build made of them." in root["description"]
    assert root["datePublished"] == DATE


@pytest.mark.parametrize(
    ("state", "said"),
    [
        ({"modified": ["src/a.py", "b.md"]}, f"commit {COMMIT}, but for changes in src/a.py, b.md, and what"),
        ({"unknown": ["c.py"]}, f"commit {COMMIT}; without these files, which git does not know: c.py, and what"),
    ],
)
def test_what_is_not_as_committed_is_named(state, said):
    root = root_of(**state)
    assert root["creativeWorkStatus"] == "modified"
    assert said in root["description"]
