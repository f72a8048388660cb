# One job per figure: its notebook, executed with the parameters of the figure. The rule bears the figure's name,
# so that `snakemake --cores 2 fig10_06` builds this figure and what it needs.

CASE_FILES = {
    "fixed_points": "results/fixed_points/{case}.csv",
    "samples": "results/simulations/{case}/samples.csv",
    "events": "results/simulations/{case}/events.csv",
    "summary": "results/simulations/{case}/summary.json",
}
NOTEBOOK_INPUTS = {
    "drawings": [],
    "closed_form": [],
    "fixed_points": ["fixed_points"],
    "theoretical_response": ["fixed_points"],
    "simulation": ["fixed_points", "samples", "events", "summary"],
}
WITHOUT_TABLE = "drawings"


def figure_inputs(scene):
    """Results of the figure's case that its notebook reads."""
    return {name: CASE_FILES[name].format(case=scene["case"]) for name in NOTEBOOK_INPUTS[scene["notebook"]]}


def figure_outputs(figure, scene):
    kinds = ["png", "pdf", "svg"] + ["csv"] * (scene["notebook"] != WITHOUT_TABLE)
    return {kind: f"results/figures/{figure}.{kind}" for kind in kinds}


def figure_settings(scene):
    """The figure's own slice of the config: its scene and the system parameters that it depends on."""
    scene = dict(scene)
    notebook, used = scene.pop("notebook"), scene.pop("parameters", [])
    system = system_of(scene["case"]) if "case" in scene else {name: config["system"][name] for name in used}
    return {**scene, "system": system}


def figure_code(figure, scene):
    """Fingerprint of script, notebook and library; the notebook imports the module of its figure by name."""
    drawn_by = f"vibroimpact.figures.{figure}"
    files = "workflow/scripts/notebook.py", f"notebooks/{scene['notebook']}.ipynb"
    return code(*files, modules=[drawn_by] if SOURCES.knows(drawn_by) else [])


for figure, scene in config["figures"].items():

    rule:
        name:
            figure
        input:
            **figure_inputs(scene),
        output:
            html=f"results/notebooks/{figure}.html",
            **figure_outputs(figure, scene),
        params:
            figure=figure,
            notebook=f"notebooks/{scene['notebook']}.ipynb",
            executed=f"results/logs/figures/{figure}.ipynb",
            settings=figure_settings(scene),
            code=figure_code(figure, scene),
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
