"""Test that random examples are the same in every run, whichever modules have been imported before."""

import sys
from importlib.util import module_from_spec, spec_from_file_location

from hypothesis import given, settings
from hypothesis import strategies as st

CONSTANTS = range(1_234_567, 1_234_667)


def drawn():
    """Return the examples that a test draws."""
    examples = []

    @settings.get_profile("same")
    @given(st.integers(), st.floats())
    def collect(i, x):
        examples.append(repr((i, x)))

    collect()
    return examples


def test_constants_of_a_module_that_happens_to_be_loaded_do_not_change_the_examples(tmp_path, monkeypatch):
    before = drawn()
    path = tmp_path / "module.py"
    path.write_text(f"A = {list(CONSTANTS)}")
    spec = spec_from_file_location("module", path)
    monkeypatch.setitem(sys.modules, "module", module_from_spec(spec))
    assert drawn() == before
    assert len(set(before)) > 50
