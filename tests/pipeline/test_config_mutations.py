"""Whatever is done to a good config: it is accepted, or refused in lines; no error that is none of ours, no hanging."""

import copy
import time

import yaml
from hypothesis import given, settings
from hypothesis import strategies as st

from configs import GOOD, TEXT
from vibroimpact_pipeline.config import complaints, parse, problems, typed

SECONDS = 10
"""Of processor time, for a config that takes a hundredth of one."""


def places(value, above=()):
    """All places in a config, with its mappings and lists."""
    yield above
    items = value.items() if isinstance(value, dict) else enumerate(value) if isinstance(value, list) else ()
    for key, item in items:
        yield from places(item, (*above, key))


PLACES = list(places(GOOD))[1:]
SCALARS = st.one_of(
    st.none(),
    st.booleans(),
    st.integers(-3, 3),
    st.integers(),
    st.integers(-(10**400), 10**400),
    st.floats(),
    st.floats(-2, 2),
    st.text(max_size=8),
    st.sampled_from(["equal", "weak", "a", "z", "kappa", "f20_hat", "simulation", "1e-3", "0100", "all", "report"]),
)
KEYS = st.one_of(st.text(max_size=8), st.sampled_from(["case", "sort", "epsilon", "range", "fig10_06", "notebook"]))
VALUES = st.one_of(
    SCALARS,
    st.recursive(SCALARS, lambda inner: st.lists(inner, max_size=8) | st.dictionaries(KEYS, inner, max_size=4)),
    st.sampled_from(PLACES).map(lambda place: copy.deepcopy(at(GOOD, place))),
)


def at(config, place):
    for part in place:
        config = config[part]
    return config


@st.composite
def mutated(draw):
    """The good config with one to four values replaced, deleted, scaled or added."""
    config = copy.deepcopy(GOOD)
    for _ in range(draw(st.integers(1, 4))):
        *above, key = draw(st.sampled_from(list(places(config))[1:] or [("system",)]))
        inside = at(config, above)
        if not isinstance(inside, dict | list):
            continue
        change = draw(st.sampled_from(["replace", "scale", "delete", "add"]))
        old = inside[key] if isinstance(inside, list) or key in inside else None
        if change == "scale" and isinstance(old, int | float) and abs(old) < 1e9:
            inside[key] = old * draw(st.sampled_from([-1, 0, 2, 0.5, 10, 100, 1e-6, 1e9]))
        elif change == "delete" and old is not None:
            del inside[key]
        elif change == "add" and isinstance(inside, dict):
            inside[draw(KEYS)] = draw(VALUES)
        else:
            inside[key] = draw(VALUES)
    return config


def lines_of(config) -> list[str]:
    """The lines that a user reads, found in time."""
    started = time.process_time()
    lines = complaints(problems(config), {"config/config.yaml": config})
    assert time.process_time() - started < SECONDS
    return lines


def are_lines(lines):
    assert all(line.isprintable() and len(line) < 1000 for line in lines), lines


@given(mutated())
@settings(max_examples=200)
def test_a_mutated_config_is_accepted_or_refused_in_lines(config):
    before = copy.deepcopy(config)
    are_lines(lines_of(config))
    assert repr(config) == repr(before)


@given(mutated())
@settings(max_examples=40)
def test_what_can_be_written_can_be_read(config):
    """Values that YAML writes in its own way are the same after reading, or refused in a line."""
    text = yaml.safe_dump(config, sort_keys=False)
    try:
        again = parse(text)
    except ValueError as refusal:
        are_lines([str(refusal)])
    else:
        assert repr(again) == repr(yaml.safe_load(text))


@given(st.integers(0, len(TEXT) - 1), st.integers(0, 30), st.text(max_size=12))
@settings(max_examples=100)
def test_damaged_text_is_accepted_or_refused_in_lines(start, length, inserted):
    text = TEXT[:start] + inserted + TEXT[start + length :]
    try:
        config = parse(text)
    except ValueError as refusal:
        are_lines([str(refusal)])
    else:
        are_lines(lines_of(config))


@given(st.recursive(st.text(max_size=12), lambda inner: st.lists(inner, max_size=3) | st.dictionaries(KEYS, inner)))
@settings(max_examples=200)
def test_overrides_are_read_or_refused_in_a_line(given_text):
    try:
        typed({"system": given_text})
    except ValueError as refusal:
        are_lines([str(refusal)])
