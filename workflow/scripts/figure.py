"""One figure: the tables of its module, written, and drawn as they were read back."""

from importlib import import_module

from vibroimpact.figures.kit import tables
from vibroimpact.figures.kit.style import save
from vibroimpact.system import System
from vibroimpact_pipeline import provenance
from vibroimpact_pipeline.jobs import running


def arguments(params, inputs) -> dict:
    """The arguments of a figure's `compute`: settings, one system or those of all cases, tables."""
    given = dict(params.settings)
    if params.get("system"):
        given["system"] = System(**params.system)
    if params.get("systems"):
        given["systems"] = {case: System(**parameters) for case, parameters in params.systems.items()}
    return given | {name: tables.read(path) for name, path in inputs.items()}


with running(snakemake) as out:
    module = import_module(f"vibroimpact.figures.{snakemake.params.figure}")
    computed = module.compute(**arguments(snakemake.params, snakemake.input))
    drawn = tables.write_all(computed, vars(out))
    made = provenance.record(snakemake)
    save(module.draw(drawn), vars(out), made)
    provenance.write(out.provenance, made)
