"""A power cut: what the disk holds then is whole, or made anew by the next build."""

import os
import subprocess
import sys

import pytest

from vibroimpact_pipeline.integrity import compiled
from vibroimpact_pipeline.report.results import Results

FIGURE = "companion_10_04"
BUILD_AND_CUT = """
mount -o loop,commit=600 disk.img disk && "$@" || exit
cp -r disk/results meant && touch disk/other && sync disk/other && cp --sparse=always disk.img cut.img
"""
"""Nothing reaches this disk unless somebody asks for it; asking for another file brings names, but no content."""
LOOK = "mount -o loop cut.img disk && cp -r disk/results found"
BUILD_AGAIN = 'mount -o loop cut.img disk && "$@" && cp -r disk/results again'


@pytest.fixture
def on_a_disk(tmp_path):
    """Runs a shell text in a directory with an ext4 disk image, in a mount namespace of its own."""
    if os.geteuid():
        pytest.skip("only root may mount a disk image")
    image, disk = tmp_path / "disk.img", tmp_path / "disk"
    disk.mkdir()
    with open(image, "wb") as file:
        file.truncate(128 << 20)
    mount = ["unshare", "--mount", "sh", "-c"]
    try:
        subprocess.run(["mkfs.ext4", "-q", "-F", image], check=True, capture_output=True)
        subprocess.run([*mount, 'mount -o loop "$0" "$1"', image, disk], check=True, capture_output=True)
    except (OSError, subprocess.CalledProcessError) as error:
        pytest.skip(f"no ext4 image can be made and mounted here: {error}")
    return lambda text: [*mount, f'cd "{tmp_path}" && {text}', "sh"]


def content(folder):
    """All that jobs wrote, by name: logs and benchmarks are Snakemake's."""
    kept = (folder / "figures", folder / "checksums")
    return {str(path.relative_to(folder)): path.read_bytes() for top in kept for path in top.rglob("*.*")}


def test_what_a_build_has_made_survives_and_nothing_empty_is_taken_for_done(tree, tmp_path, on_a_disk):
    def build(text):
        arguments = ("--snakefile", str(tree / "Snakefile"), "--directory", str(tmp_path / "disk"), FIGURE)
        return tree.snakemake(*arguments, prefix=on_a_disk(text))

    build(BUILD_AND_CUT)
    subprocess.run(on_a_disk(LOOK), check=True)
    meant = content(tmp_path / "meant")
    assert len(meant) == 12
    assert content(tmp_path / "found") == meant
    again = build(BUILD_AGAIN)
    assert "how it was made is not known any more" in again
    pictures = {name: data for name, data in content(tmp_path / "again").items() if "provenance" not in name}
    assert pictures.items() <= meant.items()


def test_the_report_does_without_a_run_time_that_was_cut_off(tmp_path):
    benchmark = tmp_path / "benchmarks/figures/fig10_06.tsv"
    benchmark.parent.mkdir(parents=True)
    benchmark.write_text("")
    assert Results(tmp_path).cost("fig10_06") is None


def test_compiled_code_that_was_cut_off_is_dropped(tmp_path, monkeypatch):
    folder = tmp_path / compiled.KEPT / "0123"
    folder.mkdir(parents=True)
    monkeypatch.setenv("NUMBA_CACHE_DIR", str(folder))
    names = {"whole.nbi", "empty.nbi", "whole.1.nbc", "empty.1.nbc"}
    for name in names:
        (folder / name).write_text("x" * ("whole" in name))
    compiled.drop_untrusted(tmp_path / "elsewhere")
    assert {path.name for path in folder.iterdir()} == names
    (tmp_path / "link").symlink_to(tmp_path)
    compiled.drop_untrusted(tmp_path / "link")
    assert {path.name for path in folder.iterdir()} == {"whole.nbi", "whole.1.nbc"}


def test_numba_itself_stumbles_over_them(tmp_path):
    """Why they are dropped."""
    (tmp_path / "one.py").write_text("import numba\n@numba.njit(cache=True)\ndef f(x):\n    return x\nprint(f(1))\n")
    environment = {**os.environ, "NUMBA_CACHE_DIR": str(tmp_path / "cache")}
    command = [sys.executable, tmp_path / "one.py"]
    subprocess.run(command, env=environment, check=True, capture_output=True)
    [index] = (tmp_path / "cache").rglob("*.nbi")
    index.write_bytes(b"")
    assert b"EOFError" in subprocess.run(command, env=environment, check=False, capture_output=True).stderr
