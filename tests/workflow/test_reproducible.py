"""Two builds from nothing give the same bytes. `make check-bytes` compares two builds of everything."""

from pathlib import Path

import pytest

from vibroimpact_pipeline.same_bytes import digests

FIGURES = ["fig10_01", "fig10_04", "fig10_06", "fig10_08"]  # one of each notebook that computes anew
COMPANIONS = ["companion_10_05", "companion_modulation"]


@pytest.mark.thorough
def test_a_second_build_gives_the_same_bytes(built, tree):
    tree.snakemake(*FIGURES, *COMPANIONS)
    made, before = digests(tree / "results"), digests(built / "results")
    assert {Path(name).stem for name in made} >= {*FIGURES, *COMPANIONS, "samples", "events", "equal"}
    assert [name for name in made if made[name] != before.get(name)] == []


def test_all_but_charts_of_timings_is_compared(built):
    left_out = {path.stem for path in (built / "results").rglob("*.png")} - {
        Path(n).stem for n in digests(built / "results")
    }
    assert left_out == {"work_precision"}
