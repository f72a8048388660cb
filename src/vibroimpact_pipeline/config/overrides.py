"""What the command line says beside the file: `snakemake --config ...`."""

from vibroimpact_pipeline.config.section import Place, written
from vibroimpact_pipeline.config.text import parse_value


def without_null(entries):
    """Entries without those that say null: so an override takes one away, a case or what is optional."""
    if isinstance(entries, dict):
        return {key: without_null(value) for key, value in entries.items() if value is not None}
    return entries


def typed(overrides, place: Place = ()):
    """Overrides with numbers as numbers: inside a mapping, the command line of Snakemake hands over text only.

    Raises:
        ValueError: a text cannot be read; with the key that it belongs to.
    """
    if isinstance(overrides, dict):
        return {key: typed(value, (*place, key)) for key, value in overrides.items()}
    if isinstance(overrides, list):
        return [typed(value, (*place, number)) for number, value in enumerate(overrides)]
    try:
        return parse_value(overrides) if isinstance(overrides, str) else overrides
    except ValueError as error:
        raise ValueError(f"{written(place)}: {error}") from None
