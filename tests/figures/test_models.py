"""The chart of models has the right errors, justifies the models in the config, and shows all models."""

import numpy as np
import pandas as pd
import pytest
import yaml

import vibroimpact as vi
from pipeline_trees import ROOT
from vibroimpact.accuracy.model_choice import CHOICES
from vibroimpact.figures import models
from vibroimpact.tables import curve, join
from vibroimpact_pipeline.specs import specs

SPECS = specs()
CONFIG = yaml.safe_load((ROOT / "config/config.yaml").read_text(encoding="utf-8"))


def scene(figure):
    """Return an entry of the chart as the rule passes it to `compute`."""
    settings, notebook = dict(CONFIG["figures"][figure]), SPECS[figure]["notebook"]
    case, model = dict(CONFIG["cases"][settings.pop("case")]), settings.pop("model")
    simulation = case.pop("simulation")
    return {
        "module": f"vibroimpact.figures.{figure}", "notebook": notebook, "model": model,
        "system": CONFIG["system"] | case, "settings": simulation if notebook == "simulation" else settings,
    }  # fmt: skip


@pytest.fixture(scope="module")
def table():
    """Return the table for all figures with a choice of models; figure 10.11 takes most of the 4 s."""
    scenes = {figure: scene(figure) for figure, entry in CONFIG["figures"].items() if "model" in entry}
    return models.compute(scenes, seconds=1e-3)


def test_each_figure_has_the_cheapest_model_within_its_tolerance(table):
    """The models are listed by cost; measured times are not used."""
    assert table["figure"].unique().tolist() == [f"fig10_{n:02d}" for n in range(6, 12)]
    for figure, rows in table.groupby("figure"):
        assert rows["model"].tolist() == [*CHOICES[SPECS[figure]["notebook"]]]
        enough = rows.loc[rows["error"] <= rows["tolerance"], "model"]
        assert enough.iloc[0] == CONFIG["figures"][figure]["model"] == rows.loc[rows["in_use"], "model"].item()


def test_errors_are_distances_from_the_reference_in_percent_of_the_axis(table):
    error = table.set_index(["figure", "model"])["error"]
    for figure, end in (("fig10_06", 3.5), ("fig10_09", 3.5)):
        system = vi.System(**scene(figure)["system"])
        exact = [orbit.C for orbit in vi.orbits(system) if orbit.symmetric]
        points = [point.C for point in vi.fixed_points(system)]
        error_of_C = max(np.abs(C - min(exact, key=lambda one: np.abs(one - C).max())).max() for C in points)
        assert error[figure, "slow_flow"] > 100 * error_of_C / end  # the error of B, whose axis is shorter, is larger
        assert error[figure, "slow_flow"] == pytest.approx(100 * error_of_C / end, rel=1.0)
    for figure in ("fig10_07", "fig10_10"):
        assert 0.1 < error[figure, "second_term"] < error[figure, "slow_flow"] / 10
    assert error["fig10_08", "float64"] < 1e-9
    assert error["fig10_11", "float64"] > 0.5
    assert not table.loc[table["model"].isin(["exact_orbit", "reference"]), "error"].any()


def test_the_largest_error_of_constructed_tables_is_known():
    tau = np.linspace(0, 1, 5)
    truth = join([curve("a", "X_2", tau=tau, value=2 * tau), curve("b", "W_2", tau=tau, value=tau)])
    other = join([curve("a", "X_2", tau=tau, value=2 * tau + 0.1), curve("b", "W_2", tau=tau, value=tau + 0.2)])
    between = join([curve("a", "X_2", tau=[0.3], value=[99.0])])
    assert models.largest_error(pd.concat([other, between]), truth) == pytest.approx(20.0)
    manifold = curve("a1", "SIM", C=[0, 2], B=[0, 1])
    planes = {label: join([curve("a1", label, C=[0.5], B=[0.2]), manifold]) for label in ("P_1", "P_2")}
    moved = planes["P_1"].assign(B=planes["P_1"]["B"] + 0.05)
    assert models.largest_error(moved, planes["P_1"]) == pytest.approx(5.0)
    for one, reference in ((planes["P_1"], planes["P_2"]), (None, truth), (truth, None)):
        assert np.isinf(models.largest_error(one, reference))


def test_all_models_are_drawn_and_labelled_and_those_in_use_are_filled():
    names = ("figure", "model", "error", "seconds", "in_use")
    rows = [("fig10_07", "slow_flow", 4.0, 0.01, True), ("fig10_07", "exact_orbit", 0.0, 0.02, False)]
    rows += [("fig10_07", "second_term", np.inf, 0.03, False), ("mine", "float64", 1e-9, 5.0, True)]
    figure = models.draw(pd.DataFrame(rows, columns=names).assign(tolerance=10.0, compared_with="exact_orbit"))
    errors, times = ([line for line in axes.lines if line.get_marker() == "o"] for axes in figure.axes[:2])
    assert [line.get_xdata()[0] for line in errors] == [4.0, models.LANE_ERROR, models.ERROR_MAX, models.LANE_ERROR]
    assert [line.get_xdata()[0] for line in times] == [0.01, 0.02, 0.03, 5.0]
    assert [line.get_markerfacecolor() for line in errors] == ["black", "white", "white", "black"]
    labels = [label.get_text().replace("   ", " ") for label in figure.axes[0].get_yticklabels()]
    assert labels == ["Fig. 10.7: slow flow", "exact orbit", "with first-order term", "mine: float64"]
    assert [line.get_ydata()[0] for line in errors] == list(figure.axes[0].get_yticks())
