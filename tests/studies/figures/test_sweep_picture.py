"""The default figure of a sweep has lines and cells at the values of the table."""

import numpy as np
import pandas as pd
import pytest

from vibroimpact.studies.figures import sweep
from vibroimpact.studies.regimes.classification import REGIMES
from vibroimpact.studies.sweeps.observations import OBSERVATIONS

LINE = [{"along": ["kappa"], "range": [0.5, 0.8], "values": 4}]
PLANE = [{"along": ["epsilon"], "range": [0.001, 1.0], "values": 4, "scale": "logarithmic"}, {"along": ["f10_hat"]}]


def table(axes, observe):
    """Return a table of a sweep with different numbers in all rows and columns."""
    values = [[0.001, 0.01, 0.1, 1.0], [0.5, 0.8, 1.0]][: len(axes)]
    moved = [values.ravel() for values in np.meshgrid(*values, indexing="ij")]
    made = pd.DataFrame({axis["along"][0]: column for axis, column in zip(axes, moved, strict=True)})
    for k, column in enumerate(column for name in observe for column in OBSERVATIONS[name][0]):
        made[column] = (k + np.arange(len(made))) / 40
    return made.assign(unsettled=0.0) if "regimes" in observe else made


def test_a_line_has_the_values_of_its_column():
    swept = table(LINE, ["amplitudes", "fixed_points"])
    figure = sweep.draw(sweep.compute(swept, LINE))
    assert len(figure.axes) == 4
    largest = {line.get_label(): line for line in figure.axes[0].lines}
    np.testing.assert_array_equal(largest["box 2"].get_ydata(), swept["largest_X2"])
    np.testing.assert_array_equal(largest["box 2"].get_xdata(), swept["kappa"])
    assert len({line.get_marker() for line in figure.axes[0].lines}) == 2  # distinguishable without colour


@pytest.mark.parametrize("axes", [LINE, PLANE])
def test_regimes_that_no_start_ends_in_are_left_out(axes):
    drawn = sweep.compute(table(axes, ["regimes"]), axes)
    assert set(drawn["series"]) == set(REGIMES) - {"unsettled"}


def test_a_map_has_a_panel_per_column_with_cells_around_points_and_blanks_for_missing_values():
    swept = table(PLANE, ["amplitudes", "fixed_points"]).assign(fixed_points=0.0)  # zeros are drawn
    swept.loc[5, "largest_X1"] = np.nan
    figure = sweep.draw(sweep.compute(swept, PLANE))
    panels = [axes for axes in figure.axes if axes.get_xlabel() == r"$\varepsilon$"]
    assert len(panels) == 8
    mesh = panels[0].collections[0]
    np.testing.assert_allclose(mesh.get_array().filled(np.nan).T.ravel(), swept["largest_X1"])
    corners = mesh.get_coordinates()
    np.testing.assert_allclose(corners[0, :, 0], 10.0 ** np.arange(-3.5, 1))
    np.testing.assert_allclose(corners[:, 0, 1], [0.35, 0.65, 0.9, 1.1])
    assert panels[0].get_xscale() == "log"
    figure.draw_without_rendering()
