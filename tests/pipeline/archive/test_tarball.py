"""An archive has the same bytes whenever and wherever it is written, and gives back what went in."""

import os
import tarfile

from vibroimpact_pipeline.archive.tarball import write

TIME = 1_700_000_000


def folder(path):
    """A file, a program, a link, and names that are long or have letters of their own."""
    path.mkdir()
    names = {"a.txt": "a", "run.sh": "#!/bin/sh\n", "é ü.csv": "x\n", "l" * 150: "long"}
    for name, text in names.items():
        (path / name).write_text(text, encoding="utf-8")
    (path / "run.sh").chmod(0o755)
    (path / "link").symlink_to("a.txt")
    return {name: path / name for name in [*names, "link"]} | {"made/up.json": b"{}"}


def test_the_same_bytes_whatever_dates_order_and_modes(tmp_path):
    members = folder(tmp_path / "one")
    write(tmp_path / "first.tar.gz", "top", members, TIME)
    others = folder(tmp_path / "two")
    for path in (tmp_path / "two").iterdir():
        if not path.is_symlink():
            path.chmod(path.stat().st_mode & 0o700)
            os.utime(path, (1, 1))
    write(tmp_path / "second.tar.gz", "top", dict(reversed(others.items())), TIME)
    assert (tmp_path / "first.tar.gz").read_bytes() == (tmp_path / "second.tar.gz").read_bytes()


def test_what_comes_out_is_what_went_in(tmp_path):
    members = folder(tmp_path / "one")
    write(tmp_path / "archive.tar.gz", "top", members, TIME)
    with tarfile.open(tmp_path / "archive.tar.gz") as archive:
        assert {member.name for member in archive} == {f"top/{name}" for name in members}
        assert {member.mtime for member in archive} == {TIME}
        archive.extractall(tmp_path / "out", filter="data")
    out = tmp_path / "out/top"
    assert os.readlink(out / "link") == "a.txt"
    assert (out / "made/up.json").read_bytes() == b"{}"
    assert os.access(out / "run.sh", os.X_OK)
    assert (out / "é ü.csv").read_text(encoding="utf-8") == "x\n"
