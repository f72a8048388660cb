"""A job does not start from an input that is not what the job before wrote, or that is of another case."""

import json
from pathlib import Path
from types import SimpleNamespace

import pytest

from job import running
from vibroimpact_pipeline.integrity import checksums

ROWS = {"equal": "case,label,C1\nequal,a,0.5\nequal,b,0.7\n", "weak": "case,label,C1\nweak,a,0.9\n"}


@pytest.fixture(autouse=True)
def tables(tmp_path, monkeypatch):
    """Fixed points of two cases with their records, in the working directory."""
    monkeypatch.chdir(tmp_path)
    for case, rows in ROWS.items():
        table_of(case).parent.mkdir(parents=True, exist_ok=True)
        table_of(case).write_text(rows)
    checksums.record(map(str, map(table_of, ROWS)))
    return tmp_path


def table_of(case):
    return Path(f"results/fixed_points/{case}.csv")


def job(*inputs, case=None, **about):
    """A job as Snakemake describes it to its script."""
    given = {"log": [], "output": ["results/out.csv"], "params": {}, "scriptdir": "workflow/scripts"}
    given["wildcards"] = {"case": case} if case else {}
    return SimpleNamespace(input=[str(path) for path in inputs], **given | about)


def run(described, during=lambda: None):
    with running(described):
        during()
        for output in described.output:
            Path(output).write_text("x\n1\n")


def test_what_is_as_it_was_written_is_used_and_the_output_goes_on_record():
    run(job(table_of("equal"), case="equal"))
    assert checksums.damaged(["results/out.csv"]) == []
    Path("results/out.csv").write_text("x\n2\n")
    assert checksums.damaged(["results/out.csv"]) == ["results/out.csv"]


def test_a_cut_input_is_refused_by_name_with_what_to_do():
    table_of("equal").write_text(ROWS["equal"][:30])
    with pytest.raises(SystemExit) as refusal:
        run(job(table_of("equal")))
    assert str(refusal.value) == (
        "results/fixed_points/equal.csv: not what was written. Build again, which makes it anew."
    )
    assert not Path("results/out.csv").exists()


@pytest.mark.parametrize("record", ["", "no checksum", "0" * 64 + "  results/fixed_points/weak.csv\n"])
def test_a_damaged_record_vouches_for_nothing(record):
    Path("results/checksums/results/fixed_points/equal.csv.sha256").write_text(record)
    with pytest.raises(SystemExit, match="not what was written"):
        run(job(table_of("equal")))


def test_two_cases_that_have_changed_places_are_refused():
    table_of("equal").write_text(ROWS["weak"])
    table_of("weak").write_text(ROWS["equal"])
    with pytest.raises(SystemExit, match=r"equal\.csv: not what was written"):
        run(job(table_of("equal")))


@pytest.mark.parametrize("about", [{"case": "equal"}, {"params": {"settings": {"case": "equal"}}}])
def test_the_case_in_a_table_without_record_is_that_which_was_asked_for(about):
    checksums.forget([str(table_of("equal"))])
    table_of("equal").write_text(ROWS["weak"])
    with pytest.raises(SystemExit, match=r"equal\.csv is of case weak, not equal\. Delete it and build again\."):
        run(job(table_of("equal"), **about))


def test_the_case_in_a_summary_is_that_which_was_asked_for():
    Path("summary.json").write_text(json.dumps({"case": "weak"}))
    with pytest.raises(SystemExit, match=r"summary\.json is of case weak, not equal"):
        run(job("summary.json", case="equal"))


def test_an_input_that_changes_while_it_is_read_is_refused():
    with pytest.raises(SystemExit, match=r"equal\.csv: changed while this was built\. Build again\."):
        run(job(table_of("equal")), during=lambda: table_of("equal").write_text(ROWS["equal"]))
    assert not checksums.has_record("results/out.csv")


def test_a_job_that_fails_leaves_no_record_of_what_was_there_before():
    run(job())
    with pytest.raises(ZeroDivisionError):
        run(job(), during=lambda: 1 / 0)
    assert not checksums.has_record("results/out.csv")
