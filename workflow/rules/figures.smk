# One job per figure, whose rule bears its name: `snakemake --cores 2 fig10_06` builds this figure and what it needs.
# What a figure reads says its SPEC in src/vibroimpact/figures/<figure>.py; a notebook draws those of the chapter.

CHAPTER = config["figures"]


def figure_plan(figure, spec):
    """Params and inputs of a figure's rule; None if the config lacks an entry or a sweep that it shows."""
    try:
        case = entry(spec["case"].format(figure=figure)) if "case" in spec else None
        paths = {name: path.format(figure=figure, case=case) for name, path in spec.get("settings", {}).items()}
        params = {"settings": {name: entry(path) for name, path in paths.items()}}
        decides = {path: params["settings"][name] for name, path in paths.items()}
    except KeyError:
        return None
    inputs = {name: path.format(case=case) for name, path in spec.get("inputs", {}).items()}
    sweeps = {path.removeprefix("results/sweeps/").removesuffix(".csv") for path in inputs.values() if "/sweeps/" in path}
    if not sweeps <= SWEEPS.keys():
        return None
    if case:
        params["system"], decides[f"cases.{case}"] = system_of(case), system_of(case)
    if spec.get("systems"):
        params["systems"], decides["cases"] = all_systems(), all_systems()
    return {"inputs": inputs, "params": {"figure": figure, "config": decides, **params}}


PLANS = {
    figure: (spec, plan)
    for figure, spec in [
        *((figure, spec_of(figure, scene, SPECS)) for figure, scene in CHAPTER.items()),
        *((figure, spec) for figure, spec in SPECS.items() if figure.startswith("companion_")),
    ]
    if (plan := figure_plan(figure, spec))
}

for figure, (spec, plan) in PLANS.items():

    if "notebook" in spec:

        rule:
            name:
                figure
            input:
                **plan["inputs"],
                notebook=own(f"notebooks/{spec['notebook']}.ipynb"),
            output:
                **in_report(figure_files(f"results/figures/{figure}", spec), "Figures of the chapter"),
                html=f"results/notebooks/{figure}.html",
            params:
                **plan["params"],
                code=FIGURES,
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
                **plan["inputs"],
            output:
                **in_report(figure_files(f"results/figures/{figure}", spec), "Companion figures"),
            params:
                **plan["params"],
                code=FIGURES,
            log:
                f"results/logs/figures/{figure}.log",
            benchmark:
                f"results/benchmarks/figures/{figure}.tsv"
            script:
                "../scripts/figure.py"


def files_of_figures(of_notebooks):
    plans = {figure: spec for figure, (spec, _) in PLANS.items() if ("notebook" in spec) == of_notebooks}
    return [path for figure, spec in plans.items() for path in figure_files(f"results/figures/{figure}", spec).values()]


rule figures:
    input:
        files_of_figures(of_notebooks=True),


rule companions:
    input:
        files_of_figures(of_notebooks=False),
        rules.coexistence.output,
