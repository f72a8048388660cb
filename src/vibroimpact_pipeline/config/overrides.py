"""What the command line says beside the file: `snakemake --config ...`."""

from collections.abc import Iterable

from vibroimpact_pipeline.config.schema import keys_at
from vibroimpact_pipeline.config.section import Place, written
from vibroimpact_pipeline.config.text import parse_value


def combined(origins: Iterable[dict]) -> dict:
    """The config that its origins make together, each laid over those before it.

    null takes away what is there, a case say, or what may be there; anywhere else it stays, for the check to find.
    """
    made = {}
    for entries in origins:
        made = _over(made, entries)
    return made


def _over(below, entries, place: Place = ()):
    made = dict(below)
    for key, value in entries.items():
        if value is None and (key in below or key in keys_at(place)):
            made.pop(key, None)
        elif isinstance(value, dict):
            under = below.get(key)
            made[key] = _over(under if isinstance(under, dict) else {}, value, (*place, key))
        else:
            made[key] = value
    return made


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
