"""Files that hold no config: refused in one line that names the file, in time, however they are made."""

import time

import pytest

from configs import GOOD, TEXT
from vibroimpact_pipeline.config import ConfigError, checked, read

LAUGHS = "a0: &a0 [ha, ha]\n" + "".join(f"a{n}: &a{n} [{', '.join([f'*a{n - 1}'] * 9)}]\n" for n in range(1, 12))
BAD = {
    "a key given twice": ("system:\n  kappa: 0.65\n  kappa: 0.7\n", "line 3, column 3"),
    "a key given twice in a list": ("a: [{b: 1, b: 1}]\n", "line 1, column 12"),
    "a list without end": ("system:\n  kappa: [0.65\n  a: 1\n", "line 3, column 4"),
    "a text without end": ('system: "\n', "line 2, column 1"),
    "a tab": ("system:\n\tkappa: 0.7\n", "line 2, column 1"),
    "an unknown alias": ("system: *name\n", "line 1, column 9"),
    "a list as key": ("cases: {[a, b]: {}}\n", "line 1, column 9"),
    "a program": ("a: !!python/object/apply:os.system [echo]\n", "line 1, column 4"),
    "another kind": ("a: !mine 3\n", "line 1, column 4"),
    "no date": ("a: 2001-99-99\n", ""),
    "an endless number": (f"a: {'9' * 5000}\n", ""),
    "a number beyond floats": (f"a: 1{':01' * 900}.5\n", ""),
    "no number": ("a: !!int ''\n", ""),
    "a zero byte": ("a: 1\0\n", ""),
    "two documents": ("a: 1\n---\na: 2\n", "line 2, column 1"),
    "deep nesting": (f"a: {'[' * 9000}\n", "nested deeper"),
    "a list": ("- 1\n", "[1] is not a mapping"),
    "nothing": ("", "nothing is not a mapping"),
    "too much": ("# \n" * 40_000, "has more than 100000 bytes"),
    "no text": (b"system: \xff\n", ""),
    "other text": (TEXT.encode("utf-16"), ""),
}
UNFIT = {
    "itself": "system: &all {kappa: *all}\n",
    "a billion laughs": LAUGHS,
    "a thousand copies": f"a: &a [{'1, ' * 900}]\nb: [{'*a, ' * 900}]\n",
    "a number as key": TEXT.replace("cases:", "cases:\n  7: {}"),
    "a truth value as key": TEXT.replace("cases:", "cases:\n  yes: {}"),
    "a truth value": TEXT.replace("kappa: 0.65", "kappa: yes"),
    "a date": TEXT.replace("kappa: 0.65", "kappa: 2001-01-01"),
    "bytes": TEXT.replace("kappa: 0.65", "kappa: !!binary aGVsbG8="),
    "a set": TEXT.replace("kappa: 0.65", "kappa: !!set {a}"),
    "a line within a name": TEXT.replace("cases:", 'cases:\n  "we\\nak": {}'),
    "colours within a key": TEXT.replace("system:", 'system:\n  "\\e[31m": 1'),
    "a long key": TEXT.replace("system:", f"system:\n  ? {'k' * 80_000}\n  : 1"),
}


def said(path, content) -> str:
    """What is said of a file, in a second at most."""
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


@pytest.mark.parametrize("change", [lambda text: "\ufeff" + text, lambda text: text.replace("\n", "\r\n")])
def test_a_byte_order_mark_and_line_ends_of_other_systems_do_no_harm(change, tmp_path):
    (tmp_path / "config.yaml").write_bytes(change(TEXT).encode())
    assert read(tmp_path / "config.yaml") == GOOD
