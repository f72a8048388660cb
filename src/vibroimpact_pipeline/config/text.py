"""From the text of a config to plain values: YAML in which nothing means another thing than it seems to."""

import math
import re
import reprlib

import yaml
from yaml.constructor import ConstructorError

LARGEST = 100_000
"""Bytes of a config; the chapter's has a tenth of that."""
DEEPEST = 20
"""Levels of nesting."""
PLAIN = {
    "str": "",
    "null": "",
    "seq": "",
    "map": "",
    "bool": r"true|True|TRUE|false|False|FALSE",
    "int": r"[-+]?(0|[1-9][0-9]*)",
    "float": r"[-+]?([0-9]+\.[0-9]*|\.[0-9]+)([eE][-+][0-9]+)?|[-+]?\.(inf|Inf|INF)|\.(nan|NaN|NAN)",
}
"""Kinds of values, and how those are written that YAML 1.1 knows under other spellings as well: 0100 is 64 there, 1:30
is 90, `yes` is true, which later versions and most readers take for something else."""
FORMS = {"seq": "sequence", "map": "mapping"}
"""What stands in the text for a value that is not a single word or number."""

PROGRAM = "__use_yte__"
"""The key by which Snakemake's own reading takes a config for a program, and runs it."""

LONGEST = 120
"""Characters of a value in an error message."""


class _Short(reprlib.Repr):
    """Values in few characters, integers of more digits than Python prints among them."""

    def repr_int(self, value, level):
        digits = int(value.bit_length() * math.log10(2)) + 1
        return super().repr_int(value, level) if digits < 1000 else f"a whole number of some {digits} digits"


_REPR = _Short()
_REPR.maxstring = _REPR.maxother = 60


def read(path) -> dict:
    """The config in a file.

    Raises:
        ValueError: the file cannot be read, or does not hold a config; in one line.
    """
    try:
        with open(path, "rb") as file:
            content = file.read(LARGEST + 1)
    except OSError as error:
        raise ValueError(error.strerror) from None
    if len(content) > LARGEST:
        raise ValueError(f"has more than {LARGEST} bytes")
    try:
        return parse(content.decode("utf-8"))
    except UnicodeDecodeError as error:
        line = content[: error.start].count(b"\n") + 1
        raise ValueError(f"line {line}: byte 0x{content[error.start]:02x} is not UTF-8") from None


def parse(text: str) -> dict:
    """The config that a YAML text holds.

    Raises:
        ValueError: the text is not YAML, is not a mapping, gives a key twice, holds a value that versions of YAML
            take for different things, or would be run as a program; in one line, with line and column.
    """
    config = _load(text)
    if not isinstance(config, dict):
        raise ValueError(f"{show(config)} is not a mapping of system, cases and figures")
    if PROGRAM in config:
        raise ValueError(f"{PROGRAM}: unknown key; a config is data, no part of it is run")
    return config


def parse_value(text: str):
    """The value that a piece of YAML stands for.

    Raises:
        ValueError: as `parse`, without the place.
    """
    return _load(text, place=lambda mark: "")


def show(value) -> str:
    """A value in an error message, on one line and not long; a number as it would be written in the config."""
    if value is None:
        return "nothing"
    text = _REPR.repr(value)
    if len(text) > LONGEST:
        return f"{text[: LONGEST // 2]}...{text[-LONGEST // 2 :]}"
    plain = isinstance(value, float) and "e" in text and "." not in text
    return text.replace("e", ".0e") if plain else text


def limit(value):
    """A limit as it would be written; words as they are."""
    if isinstance(value, float):
        return show(int(value) if value.is_integer() else value)
    return value


def _line_and_column(mark):
    return f"line {mark.line + 1}, column {mark.column + 1}: "


def _load(text, place=_line_and_column):
    try:
        return yaml.load(text, _Loader)
    except yaml.MarkedYAMLError as error:
        raise ValueError(f"{place(error.problem_mark or error.context_mark)}{error.problem}") from None
    except yaml.YAMLError as error:
        raise ValueError(" ".join(str(error).split())) from None


class _Loader(yaml.SafeLoader):
    """YAML with keys that are texts given once, few and plain aliases, and numbers in decimal digits."""

    def __init__(self, text):
        super().__init__(text)
        self.above = []
        self.repeated = 0

    def compose_node(self, parent, index):
        """A node, once it is known that it can be taken apart in reasonable time."""
        event = self.peek_event()
        if isinstance(event, yaml.AliasEvent):
            self.repeat(event)
        elif event.anchor in self.anchors:
            _refuse(event, f"name &{event.anchor} given twice")
        if len(self.above) == DEEPEST:
            _refuse(event, f"nested deeper than {DEEPEST} levels")
        self.above.append(getattr(event, "anchor", None))
        node = super().compose_node(parent, index)
        self.above.pop()
        return node

    def repeat(self, alias):
        """Count what an alias stands for, so that a short text holds no long config."""
        if any(self.above):
            _refuse(alias, f"alias *{alias.anchor} stands inside a value that has a name itself")
        if node := self.anchors.get(alias.anchor):
            self.repeated += node.end_mark.index - node.start_mark.index
        if self.repeated > LARGEST:
            _refuse(alias, f"aliases repeat more than {LARGEST} characters")

    def construct_object(self, node, deep=False):
        kind = node.tag.removeprefix("tag:yaml.org,2002:")
        if kind not in PLAIN:
            _refuse(
                node, f"{_text(node)} is of the kind {_word(kind)}; a config holds numbers, text, lists and mappings"
            )
        if node.id != FORMS.get(kind, "scalar"):
            _refuse(node, f"{_text(node)} cannot be read as {kind}")
        try:
            value = super().construct_object(node, deep)
        except (ValueError, LookupError, ArithmeticError):
            _refuse(node, f"{_text(node)} cannot be read as {kind}")
        if PLAIN[kind] and not re.fullmatch(PLAIN[kind], node.value):
            _refuse(node, f"{_text(node)} means {show(value)} in YAML: write that, or {show(node.value)} for the text")
        return value

    def construct_mapping(self, node, deep=False):
        seen = set()
        for key, _ in node.value:
            if key.tag != "tag:yaml.org,2002:str":
                _refuse(key, f"{_text(key)} is not text, as a key has to be")
            if key.value in seen:
                _refuse(key, f"key {key.value!r} given twice")
            seen.add(key.value)
        return super().construct_mapping(node, deep)


def _refuse(node, problem):
    raise ConstructorError(None, None, problem, node.start_mark)


def _text(node):
    if not isinstance(node, yaml.ScalarNode):
        return f"a {node.id}"
    return _word(node.value)


def _word(text):
    """A word as it is; with spaces, odd characters or of great length as an error message shows it."""
    return text if re.fullmatch(r"[\w.:+!/-]{1,60}", text) else show(text)
