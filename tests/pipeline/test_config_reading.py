"""Test that any file without a valid config is refused quickly, in one line that names the file."""

import time

import pytest
import yaml

from configs import LAUGHS, TEXT
from vibroimpact_pipeline.config import ConfigError, checked, read

BAD = {
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
UNFIT = {
    "itself": "system: &all {kappa: *all}\n",
    "a billion laughs": LAUGHS,
    "a number as key": TEXT.replace("cases:", "cases:\n  7: {}"),
    "a truth value": TEXT.replace("kappa: 0.65", "kappa: yes"),
    "bytes": TEXT.replace("kappa: 0.65", "kappa: !!binary aGVsbG8="),
    "a line within a name": TEXT.replace("cases:", 'cases:\n  "we\\nak": {}'),
    "a long key": TEXT.replace("system:", f"system:\n  ? {'k' * 80_000}\n  : 1"),
}


def said(path, content) -> str:
    """Return the error message for a file; reading it must take at most a second."""
    path.write_bytes(content if isinstance(content, bytes) else content.encode())
    started = time.process_time()
    with pytest.raises(ConfigError) as refusal:
        checked(content := read(path), [(path, content)])
    assert time.process_time() - started < 2
    return str(refusal.value)


@pytest.mark.parametrize("what", BAD)
def test_a_file_that_holds_no_config_is_refused_in_a_line(what, tmp_path):
    content, place = BAD[what]
    line = said(tmp_path / "config.yaml", content)
    assert line.startswith(f"{tmp_path}/config.yaml: {place}")
    assert line.isprintable()
    assert len(line) < len(str(tmp_path)) + 160


@pytest.mark.parametrize("what", UNFIT)
def test_values_that_no_config_holds_are_refused_in_lines(what, tmp_path):
    for line in said(tmp_path / "config.yaml", UNFIT[what]).split("\n"):
        assert line.startswith(f"{tmp_path}/config.yaml: ")
        assert line.isprintable()
        assert len(line) < len(str(tmp_path)) + 400


@pytest.mark.parametrize("name", ["none.yaml", "."])
def test_a_file_that_cannot_be_opened_is_refused_in_a_line(name, tmp_path):
    with pytest.raises(ConfigError, match=r"^[^\n]+: (No such file or directory|Is a directory)$"):
        read(tmp_path / name)


def test_numbers_and_keys_are_read_as_they_are_written(tmp_path):
    """Numbers that YAML 1.1 would read differently may be quoted texts; a key that is a word for false is a text."""
    numbers = {"0": 0, "-7": -7, "1_000": 1000, "0.25": 0.25, "1.0e-3": 0.001, "0x10": 16, "'0200'": "0200"}
    (tmp_path / "config.yaml").write_text(f"no: [{', '.join(numbers)}]\n")
    assert read(tmp_path / "config.yaml") == {"no": [*numbers.values()]}


@pytest.mark.parametrize("change", [lambda text: "\ufeff" + text, lambda text: text.replace("\n", "\r\n")])
def test_a_byte_order_mark_and_line_ends_of_other_systems_do_no_harm(change, tmp_path):
    (tmp_path / "config.yaml").write_bytes(change(TEXT).encode())
    assert read(tmp_path / "config.yaml") == yaml.safe_load(TEXT)
