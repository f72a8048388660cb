"""Figures drawn once, as reference, and verdicts on figures drawn anew."""

import pytest

from checking import LIMITS, build, copy_pictures
from vibroimpact_pipeline.figure_check import compare as figure_check


@pytest.fixture(scope="session")
def computed(figures):
    return {name: scene.compute and scene.compute() for name, scene in figures.items()}


@pytest.fixture(scope="session")
def reference(figures, computed, tmp_path_factory):
    folder = tmp_path_factory.mktemp("reference")
    for name, scene in figures.items():
        build(folder, name, computed[name], scene.draw(computed[name]))
    return folder


@pytest.fixture
def verdict(reference, tmp_path):
    """The verdict on a figure that was computed and drawn anew."""

    def judge(name, table, figure):
        build(tmp_path, name, table, figure)
        return figure_check.check(name, reference, tmp_path, LIMITS)

    return judge


@pytest.fixture
def verdict_without_pixels(reference, tmp_path):
    """The same with the picture of the reference, so that numbers and artists alone can tell."""

    def judge(name, table, figure):
        build(tmp_path, name, table, figure, pictures=False)
        copy_pictures(name, reference, tmp_path)
        return figure_check.check(name, reference, tmp_path, LIMITS)

    return judge
