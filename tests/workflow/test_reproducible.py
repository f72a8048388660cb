"""Two builds from nothing give the same bytes. `make check-bytes` compares two builds of everything."""

FIGURES = ["fig10_01", "fig10_04", "fig10_06", "fig10_08"]  # one of each notebook that computes anew
WITHOUT_TIMING = {".csv", ".png", ".svg", ".pdf"}


def test_a_second_build_gives_the_same_bytes(built, tree):
    tree.snakemake(*FIGURES)
    made = [path.relative_to(tree.path) for path in (tree / "results").rglob("*") if path.suffix in WITHOUT_TIMING]
    assert {path.stem for path in made} >= {*FIGURES, "samples", "events", "equal"}
    different = [str(path) for path in made if (tree / path).read_bytes() != (built / path).read_bytes()]
    assert different == []
