# Where figures come from: what decides on each is written down before anything runs, and goes with it as its record.

DOUBLE = sys.float_info.dig
# Steps before a figure: who makes its inputs, by which method, with how many decimal digits.
STEPS = {
    "fixed_points": (
        "all solutions of (10.23): real zeros of (10.24), refined by Newton's method",
        DOUBLE,
        "workflow/scripts/fixed_points.py",
    ),
    "orbits": (
        "all 1:1 responses of (10.1), refined by Newton's method, with their Floquet multipliers",
        DOUBLE,
        "workflow/scripts/orbits.py",
    ),
    "verdicts": ("four criteria of stability on every fixed point", DOUBLE, "workflow/scripts/verdicts.py"),
    "simulation": (
        "direct integration of (10.1), event by event, with free flight in closed form",
        DOUBLE,
        "workflow/scripts/simulate.py",
    ),
    "tile_of_sweep": (
        "what is asked, at every point of the case with one or two parameters moved",
        DOUBLE,
        "workflow/scripts/sweep_tile.py",
    ),
    "coexistence": (
        "direct integration of (10.1) until a periodic motion catches a start, censored; tori swept both ways",
        DOUBLE,
        "workflow/scripts/coexistence.py",
    ),
}
EXACT = "direct integration of (10.1), event by event, in ball arithmetic, proved by doubling the digits"


def step(method, digits, *files, modules=()):
    """A step of the computation: its method, the decimal digits it works with, and the code that takes it."""
    fingerprint = code(*files, modules=modules)
    return {"method": method, "digits": digits, "files": [*files], "modules": [*modules], "fingerprint": fingerprint}


def exact(case):
    """Whether the motion of a case is computed with so many digits that all its numbers can be reproduced."""
    return "digits" in config["cases"][case]["simulation"]


def simulation_step(case):
    method, digits, script = STEPS["simulation"]
    return (
        step(EXACT, config["cases"][case]["simulation"]["digits"], script)
        if exact(case)
        else step(*STEPS["simulation"])
    )


def config_at(path):
    """The entry of the config at "section.key"."""
    value = config
    for key in path.split("."):
        value = value[key]
    return value


def provenance(figure, keys, cases, steps):
    """What decides on a figure: entries of the config by their paths, the parameters of cases, the steps to its files."""
    paths = [*keys, *(f"system.{name}" for name in config["system"] if cases)]
    paths += [f"cases.{case}.{name}" for case in cases for name in ("f10_hat", "f20_hat")]
    return {"figure": figure, "config": {path: config_at(path) for path in paths}, "steps": steps}


def figure_files(stem, with_table=True):
    """Files of a figure by kind: pictures, what they show, where they come from, and the table that is plotted."""
    kinds = ["png", "pdf", "svg", "provenance.json"] + ["csv"] * with_table
    return {kind.removesuffix(".json"): f"{stem}.{kind}" for kind in kinds}
