"""Test which parts of a vector picture affect its checksum."""

import pytest

from vibroimpact_pipeline.figure_check.pictures import COMPARED_CONTENT


@pytest.mark.parametrize(("moved", "same"), [(b"1.23412", True), (b"1.23456", False), (b"1.24412", False)])
def test_coordinates_count_to_a_thousandth(moved, same):
    path = b'<svg><path d="M %s 2.5"/></svg>'
    assert (COMPARED_CONTENT["svg"](path % b"1.23401") == COMPARED_CONTENT["svg"](path % moved)) is same
