# One job per figure, whose rule bears its name: `snakemake --cores 2 fig10_06` builds this figure and what it needs.
# What a figure reads says its SPEC in src/vibroimpact/figures/<figure>.py; a notebook draws those of the chapter.

CHAPTER = config["figures"]


def figure_plan(figure, spec):
    """Inputs and params of a figure's rule; None if the config lacks an entry or a sweep that it shows."""
    try:
        asked = request(figure, spec, config)
    except LookupError:
        return None
    decides = {path: asked["settings"][name] for name, path in asked["paths"].items()}
    systems = {}
    if asked["case"]:
        systems["system"] = decides[f"cases.{asked['case']}"] = system_of(asked["case"])
    if spec.get("systems"):
        systems["systems"] = decides["cases"] = all_systems()
    params = {"figure": figure, "case": asked["case"], "settings": asked["settings"], "config": decides, **systems}
    return asked["inputs"], params


PLANS = {
    figure: (spec, *plan)
    for figure, spec in [
        *((figure, spec_of(figure, scene, SPECS)) for figure, scene in CHAPTER.items()),
        *((figure, spec) for figure, spec in SPECS.items() if figure.startswith("companion_")),
    ]
    if (plan := figure_plan(figure, spec))
}

for figure, (spec, inputs, params) in PLANS.items():

    if "notebook" in spec:

        rule:
            name:
                figure
            input:
                **inputs,
                notebook=own(f"notebooks/{spec['notebook']}.ipynb"),
            output:
                **in_report(figure_files(f"results/figures/{figure}", spec), "Figures of the chapter"),
                html=f"results/notebooks/{figure}.html",
            params:
                **params,
                scene=CHAPTER[figure],
                code=FIGURES | {"pipeline": PIPELINE["pipeline"]},
            priority: 10
            log:
                f"results/logs/figures/{figure}.log",
            benchmark:
                f"results/benchmarks/figures/{figure}.tsv"
            script:
                "../scripts/notebook.py"

    else:

        rule:
            name:
                figure
            input:
                **inputs,
            output:
                **in_report(figure_files(f"results/figures/{figure}", spec), "Companion figures"),
            params:
                **params,
                code=FIGURES,
            log:
                f"results/logs/figures/{figure}.log",
            benchmark:
                f"results/benchmarks/figures/{figure}.tsv"
            script:
                "../scripts/figure.py"


def files_of_figures(of_notebooks):
    plans = {figure: spec for figure, (spec, *_) in PLANS.items() if ("notebook" in spec) == of_notebooks}
    return [path for figure, spec in plans.items() for path in figure_files(f"results/figures/{figure}", spec).values()]


rule figures:
    input:
        files_of_figures(of_notebooks=True),


rule companions:
    input:
        files_of_figures(of_notebooks=False),
        rules.coexistence.output,
