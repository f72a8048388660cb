"""Smallest errors that are visible in a printed figure."""


def smallest_visible_error(figure) -> float:
    """The smallest error that the lines of a figure can show, as a share of an axis: half the thinnest line's width."""
    if engine := figure.get_layout_engine():
        engine.execute(figure)
    shares = []
    for axes in figure.axes:
        widths = [line.get_linewidth() for line in axes.lines if line.get_linestyle() != "None"]
        height = axes.get_window_extent().height * 72.0 / figure.dpi
        shares += [0.5 * min(widths) / height] if widths else []
    return min(shares)
