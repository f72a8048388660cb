"""The published tables of the studies, changed: what the figure check notices."""

import pytest

from published_tables import tables_in, unnoticed
from vibroimpact_pipeline.figure_check.table_distances import KINDS
from vibroimpact_pipeline.specs import each, specs

STANDARD_ERRORS = {"companion_epsilon.orders": ["uncertainty"]}
"""Of fits to errors: their digits are those of rounding."""


@pytest.mark.parametrize("name", tables_in("figures/studies"))
def test_one_number_off_by_a_per_cent_fails(name):
    assert unnoticed(name, STANDARD_ERRORS.get(name, ())) == []


def test_every_kind_is_used():
    tables = [table for spec in specs().values() for table in spec["tables"].values()]
    kinds = [entry["compared"] for table in tables for entry in each(table["columns"]).values() if "compared" in entry]
    assert {name for kind in kinds for name in (kind.values() if isinstance(kind, dict) else [kind])} == set(KINDS)
