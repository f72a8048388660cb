# One job per figure: its notebook, executed with the parameters of the figure. The rule bears the figure's name,
# so that `snakemake --cores 2 fig10_06` builds this figure and what it needs.

CASE_FILES = {
    "fixed_points": "results/fixed_points/{case}.csv",
    "samples": "results/simulations/{case}/samples.csv",
    "events": "results/simulations/{case}/events.csv",
    "summary": "results/simulations/{case}/summary.json",
}
# What a figure is given to read is what its model needs, and no more; a drawing has none.
MODEL_INPUTS = {
    None: [],
    "closed_form": [],
    "slow_flow": ["fixed_points"],
    "simulation": ["fixed_points", "samples", "events", "summary"],
}
WITHOUT_TABLE = "drawings"

# Who makes the inputs and the figures, by which method; for the record that goes with each figure.
SCRIPTS = {
    "fixed_points": "workflow/scripts/fixed_points.py",
    "samples": "workflow/scripts/simulate.py",
}
METHODS = {
    "fixed_points": "all solutions of (10.23): real zeros of (10.24), refined by Newton's method",
    "samples": "direct integration of (10.1), event by event, with free flight in closed form",
    "exact samples": "direct integration of (10.1), event by event, in ball arithmetic, proved by doubling the digits",
}
NOTEBOOK_METHODS = {
    "drawings": "drawn to scale, nothing computed",
    "closed_form": "closed form: (10.11), (10.16), (10.25), (10.26)",
    "fixed_points": "manifold in closed form, singular points as real zeros of (10.24)",
    "theoretical_response": "leading order, (10.9) and (10.10), at a fixed point",
    "simulation": "motion of the second module as simulated, with its events as corners",
}
DOUBLE = sys.float_info.dig


def figure_inputs(scene):
    """Results of the figure's case that its notebook reads."""
    return {name: CASE_FILES[name].format(case=scene["case"]) for name in MODEL_INPUTS[scene.get("model")]}


def figure_outputs(figure, scene):
    kinds = ["png", "pdf", "svg"] + ["csv"] * (scene["notebook"] != WITHOUT_TABLE)
    told = {name: f"results/figures/{figure}.{name}.json" for name in ("artists", "provenance")}
    if scene["notebook"] == "simulation" and exact(scene["case"]):
        told["statistics"] = f"results/figures/{figure}.statistics.csv"
    return {kind: f"results/figures/{figure}.{kind}" for kind in kinds} | told


def exact(case):
    """Whether the motion of a case is computed with so many digits that all its numbers can be reproduced."""
    return "digits" in config["cases"][case]["simulation"]


def figure_settings(scene):
    """The figure's own slice of the config: its scene and the system parameters that it depends on."""
    scene = dict(scene)
    scene.pop("notebook"), scene.pop("model", None)
    used = scene.pop("parameters", [])
    system = system_of(scene["case"]) if "case" in scene else {name: config["system"][name] for name in used}
    return {**scene, "system": system}


def figure_step(figure, scene):
    """How the figure itself is made. Its notebook imports the module of the figure by name."""
    drawn_by = f"vibroimpact.figures.{figure}"
    modules = [drawn_by] if SOURCES.knows(drawn_by) else []
    files = "workflow/scripts/notebook.py", f"notebooks/{scene['notebook']}.ipynb"
    return step(NOTEBOOK_METHODS[scene["notebook"]], DOUBLE, *files, modules=modules)


def step_before(name, scene):
    """How an input of a figure is made."""
    if name == "samples" and exact(scene["case"]):
        return step(METHODS["exact samples"], config["cases"][scene["case"]]["simulation"]["digits"], SCRIPTS[name])
    return step(METHODS[name], DOUBLE, SCRIPTS[name])


def step(method, digits, *files, modules=()):
    """A step of the computation: its method, the decimal digits it works with, and the code that takes it."""
    fingerprint = code(*files, modules=modules)
    return {"method": method, "digits": digits, "files": [*files], "modules": [*modules], "fingerprint": fingerprint}


def figure_origin(figure, scene):
    """What decides on a figure: its slice of the config, by the path of each key, and the steps up to its files."""
    read = MODEL_INPUTS[scene.get("model")]
    used = config["system"] if "case" in scene else scene.get("parameters", [])
    values = {f"system.{name}": config["system"][name] for name in used}
    if "case" in scene:
        of_case = ["f10_hat", "f20_hat"] + ["simulation"] * ("samples" in read)
        values |= {f"cases.{scene['case']}.{name}": config["cases"][scene["case"]][name] for name in of_case}
    before = [step_before(name, scene) for name in read if name in SCRIPTS]
    return {
        "config": {f"figures.{figure}": scene, **values},
        "steps": [*before, figure_step(figure, scene)],
    }


for figure, scene in config["figures"].items():

    rule:
        name:
            figure
        input:
            **figure_inputs(scene),
        output:
            html=f"results/notebooks/{figure}.html",
            **in_report(figure_outputs(figure, scene), "Figures of the chapter", figure),
        params:
            figure=figure,
            notebook=f"notebooks/{scene['notebook']}.ipynb",
            executed=f"results/logs/figures/{figure}.ipynb",
            settings=figure_settings(scene),
            origin=figure_origin(figure, scene),
        log:
            f"results/logs/figures/{figure}.log",
        benchmark:
            f"results/benchmarks/figures/{figure}.tsv"
        script:
            "../scripts/notebook.py"


rule figures:
    input:
        [f"results/notebooks/{figure}.html" for figure in config["figures"]],
        [path for figure, scene in config["figures"].items() for path in figure_outputs(figure, scene).values()],
