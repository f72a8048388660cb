"""The work-precision chart and the hazards picture show every row that they are given, failures included."""

import pandas as pd

from vibroimpact.figures import hazards, work_precision

ROW = dict(
    problem="s", method="a", family="Taylor", setting="1", error_state=1e-6, error_time=1e-7, missed=0, spurious=0
)
ROW |= dict(seconds_per_cycle=1e-3, outcome="finished", reason="", order=None)


def texts(figure):
    return [text.get_text() for text in figure.findobj(lambda artist: hasattr(artist, "get_text"))]


def test_chart_keeps_failed_and_unavailable_methods():
    rows = [
        ROW,
        ROW | dict(setting="2", missed=1),
        ROW | dict(method="b", error_state=float("inf"), error_time=float("inf"), outcome="refused", reason="gave up"),
        ROW | dict(method="c", seconds_per_cycle=None, outcome="unavailable", reason="not installed"),
    ]
    figure = work_precision.draw(pd.DataFrame(rows), footer="versions")
    shown = "\n".join(texts(figure))
    for expected in ("1  b: gave up", "c: unavailable (not installed)", "versions"):
        assert expected in shown
    points = [
        line for line in figure.findobj(lambda a: hasattr(a, "get_xdata")) if line.get_marker() not in ("", "None")
    ]
    drawn = {(x, y) for line in points for x, y in zip(line.get_xdata(), line.get_ydata(), strict=True)}
    assert (1e-6, 1e-3) in drawn
    assert any(x > work_precision.LARGEST and y == 1e-3 for x, y in drawn)


def test_each_kind_of_method_has_its_own_colour_and_mark_and_each_method_its_name():
    rows = [ROW | dict(method=kind, family=kind) for kind in work_precision.KINDS]
    rows += [ROW | dict(method=f"another {kind}", family=kind) for kind in ("Taylor", "solve_ivp")]
    figure = work_precision.draw(pd.DataFrame(rows), footer="")
    looks = work_precision.KINDS.values()
    assert len({colour for colour, *_ in looks}) == len({marker for _, marker, _ in looks}) == len(looks)
    (key,) = (legend for part in figure.subfigs for legend in part.legends)
    *kinds, hollow = [text.get_text() for text in key.get_texts()]
    assert {*kinds} == {"Taylor", "solve_ivp", *work_precision.CROWDED}
    *shown, _ = [(line.get_color(), line.get_marker()) for line in key.get_lines()]
    assert shown == [work_precision.KINDS[kind][:2] for kind in kinds]
    assert (hollow, key.get_lines()[-1].get_markerfacecolor()) == ("hollow: other impacts", "white")
    named = {text.get_text() for text in figure.subfigs[0].axes[0].texts}
    assert named - {"better"} == {row["method"] for row in rows} - set(work_precision.CROWDED)


def test_a_group_of_stress_tests_has_its_worst_verdict_and_the_number_of_right_ones():
    verdicts = list(hazards.VERDICTS)
    rows = [dict(group=worst, method="m", verdict=verdict) for worst in verdicts for verdict in ("right", worst)]
    shown = texts(hazards.draw(pd.DataFrame(rows)))
    for verdict, (mark, _) in hazards.VERDICTS.items():
        assert f"{mark}  {verdict}" in shown
        assert shown.count(mark) == (0 if verdict == "unavailable" else 2 if verdict == "right" else 1)
    assert [shown.count("2/2"), shown.count("1/2")] == [1, len(verdicts) - 1]


def test_a_verdict_has_its_numbers_behind_it():
    row = dict(verdict="silently wrong", error_state=3e-5, missed=1, spurious=2)
    table = pd.DataFrame([row, row | dict(verdict="right", missed=0, spurious=0), row | dict(error_state=float("nan"))])
    assert [hazards.cell(row) for row in table.itertuples()] == ["×\xa03e−5\xa0−1+2", "✓\xa03e−5", "×"]


def test_no_text_is_too_small_to_read():
    failed = ROW | dict(method="b", error_state=float("inf"), error_time=float("inf"), outcome="refused", reason="no")
    verdict = dict(group="g", hazard="h", method="m", verdict="right", error_state=3e-5, missed=12, spurious=34)
    for figure in (work_precision.draw(pd.DataFrame([ROW, failed]), "versions"), hazards.draw(pd.DataFrame([verdict]))):
        drawn = figure.findobj(lambda artist: hasattr(artist, "get_fontsize") and artist.get_text())
        assert min(text.get_fontsize() for text in drawn) >= 7
