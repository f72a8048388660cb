"""Test that files without a valid config are refused quickly, with errors of one line that name the file."""

import time

import pytest
import yaml

from configs import LAUGHS, TEXT
from vibroimpact_pipeline.config import ConfigError, checked, read

NOT_A_CONFIG = {
    "a key given twice": ("system:\n  kappa: 0.65\n  kappa: 0.7\n", "line 3, column 3"),
    "a text without end": ('system: "\n', "line 2, column 1"),
    "a list as key": ("cases: {[a, b]: {}}\n", "line 1, column 9"),
    "a program": ("a: !!python/object/apply:os.system [echo]\n", "line 1, column 4"),
    "an endless number": (f"a: {'9' * 5000}\n", ""),
    "a number beyond floats": (f"a: 1{':01' * 900}.5\n", ""),
    "an octal number": ("a: -0200\n", "line 1, column 4: -0200 means -128 in YAML; write a decimal number"),
    "a fraction to base 60": ("a: 1:30.5\n", "line 1, column 4: 1:30.5 means 90.5 in YAML"),
    "a zero byte": ("a: 1\0\n", ""),
    "deep nesting": (f"a: {'[' * 1000}\n", "maximum recursion depth"),
    "a list": ("- 1\n", "[1] should be a mapping"),
    "too much": ("# \n" * 40_000, "file is larger than 100000 bytes"),
    "other text": (TEXT.encode("utf-16"), ""),
}
INVALID_VALUES = {
    "itself": "system: &all {kappa: *all}\n",
    "a billion laughs": LAUGHS,
    "a number as key": TEXT.replace("cases:", "cases:\n  7: {}"),
    "a truth value": TEXT.replace("kappa: 0.65", "kappa: yes"),
    "bytes": TEXT.replace("kappa: 0.65", "kappa: !!binary aGVsbG8="),
    "a line within a name": TEXT.replace("cases:", 'cases:\n  "we\\nak": {}'),
    "a long key": TEXT.replace("system:", f"system:\n  ? {'k' * 80_000}\n  : 1"),
}


def errors_of(folder, content) -> list[str]:
    """Return the errors of a config file without its path; reading the file must take at most two seconds."""
    path = folder / "config.yaml"
    path.write_bytes(content if isinstance(content, bytes) else content.encode())
    started = time.process_time()
    with pytest.raises(ConfigError) as refusal:
        checked(content := read(path), [(path, content)])
    assert time.process_time() - started < 2
    lines = str(refusal.value).split("\n")
    assert all(line.startswith(f"{path}: ") and line.isprintable() for line in lines)
    return [line.removeprefix(f"{path}: ") for line in lines]


@pytest.mark.parametrize("name", NOT_A_CONFIG)
def test_a_file_that_is_not_a_config_is_refused_with_one_error(name, tmp_path):
    content, place = NOT_A_CONFIG[name]
    (error,) = errors_of(tmp_path, content)
    assert error.startswith(place)
    assert len(error) < 146


@pytest.mark.parametrize("name", INVALID_VALUES)
def test_errors_of_invalid_values_are_short_lines(name, tmp_path):
    assert max(map(len, errors_of(tmp_path, INVALID_VALUES[name]))) < 386


@pytest.mark.parametrize("name", ["none.yaml", "."])
def test_a_file_that_cannot_be_opened_is_refused_with_one_error(name, tmp_path):
    with pytest.raises(ConfigError, match=r"^[^\n]+: (No such file or directory|Is a directory)$"):
        read(tmp_path / name)


def test_numbers_and_keys_are_read_as_written(tmp_path):
    """Quotes make a text of a number that YAML 1.1 would change. The key `no` is a text, not false."""
    numbers = {"0": 0, "-7": -7, "1_000": 1000, "0.25": 0.25, "1.0e-3": 0.001, "0x10": 16, "'0200'": "0200"}
    (tmp_path / "config.yaml").write_text(f"no: [{', '.join(numbers)}]\n")
    assert read(tmp_path / "config.yaml") == {"no": [*numbers.values()]}


@pytest.mark.parametrize("change", [lambda text: "\ufeff" + text, lambda text: text.replace("\n", "\r\n")])
def test_a_byte_order_mark_and_carriage_returns_are_ignored(change, tmp_path):
    (tmp_path / "config.yaml").write_bytes(change(TEXT).encode())
    assert read(tmp_path / "config.yaml") == yaml.safe_load(TEXT)
