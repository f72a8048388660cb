"""Compiled code on disk: what is damaged is never run, but said, removed and compiled anew."""

import multiprocessing
import os
import re
import runpy
import shutil
import subprocess
import sys

import pytest
from numba import config

from pipeline_trees import ROOT

FUNCTION = """
from vibroimpact.exact.engine.compiled import kept

@kept()
def cube(x):
    return x * x * x

print(cube(3.0))
"""
SIMULATE = """
import vibroimpact as vi
from vibroimpact.system.chapter import CASES, PARAMETERS
print(list(vi.simulate(vi.System(**PARAMETERS, **CASES["equal"]), [0.0] * 8, cycles=5).final))
"""
DAMAGE = {
    "emptied": lambda content: b"",
    "cut after a byte": lambda content: content[:1],
    "cut in half": lambda content: content[: len(content) // 2],
    "last byte cut off": lambda content: content[:-1],
    "a byte too many": lambda content: content + b"x",
    "first bit": lambda content: flipped(content, 0),
    "bit in the middle": lambda content: flipped(content, len(content) // 2),
    "last bit": lambda content: flipped(content, len(content) - 1),
    "zeros": lambda content: bytes(len(content)),
    "zeros from the middle on": lambda content: content[: len(content) // 2] + bytes(len(content) // 2),
}


def flipped(content, place):
    return content[:place] + bytes([content[place] ^ 1]) + content[place + 1 :]


@pytest.fixture
def compiled(tmp_path, monkeypatch, capfd):
    """Runs a function as a process does that has only just started; returns what it printed and said."""
    monkeypatch.setattr(config, "CACHE_DIR", str(tmp_path))
    script = tmp_path / "script.py"
    script.write_text(FUNCTION)

    def run():
        process = multiprocessing.get_context("fork").Process(target=runpy.run_path, args=(str(script),))
        process.start()
        process.join()
        assert process.exitcode == 0, capfd.readouterr().err
        return capfd.readouterr()

    run()
    return run


@pytest.mark.parametrize("kind", ["nbi", "nbc"])
@pytest.mark.parametrize("damage", DAMAGE)
def test_a_damaged_file_is_said_and_compiled_anew(compiled, tmp_path, damage, kind):
    [path] = tmp_path.rglob(f"*.{kind}")
    path.write_bytes(DAMAGE[damage](path.read_bytes()))
    printed, said = compiled()
    assert printed == "27.0\n"
    assert said == f"vibroimpact: {path} is damaged: removed, what it held is compiled anew\n"
    assert compiled() == ("27.0\n", "")


def test_sound_code_is_used_and_nothing_is_written(compiled, tmp_path):
    def times():
        return {path: path.stat().st_mtime_ns for path in tmp_path.rglob("*.nb[ci]")}

    before = times()
    assert len(before) == 2
    assert compiled() == ("27.0\n", "")
    assert times() == before


@pytest.mark.thorough
def test_the_engine_survives_damage(tmp_path):
    """The code of the loop of events, as the tests use it, with a bit flipped in the middle."""
    for folder in (ROOT / "src/vibroimpact/__pycache__").glob("compiled-*/engine_*"):
        shutil.copytree(folder, tmp_path / folder.name, dirs_exist_ok=True)

    def simulate():
        command = [sys.executable, "-c", SIMULATE]
        environment = os.environ | {"NUMBA_CACHE_DIR": str(tmp_path)}
        return subprocess.run(command, env=environment, capture_output=True, text=True, check=True)

    sound = simulate()
    [path] = tmp_path.rglob("event_loop.integrate-*.nbc")
    path.write_bytes(flipped(path.read_bytes(), path.stat().st_size // 2))
    mended = simulate()
    assert mended.stdout == sound.stdout
    assert re.match(
        rf"vibroimpact: {re.escape(str(path))} is damaged: removed, .*\nvibroimpact: compiling", mended.stderr
    )
    assert simulate().stderr == ""
