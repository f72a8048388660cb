# One job per figure, whose rule bears its name: `snakemake --cores 2 fig10_06` builds this figure and what it needs.
# What a figure reads says its SPEC in src/vibroimpact/figures/<figure>.py; a notebook draws those of the chapter.

CHAPTER = config["figures"]


def figure_params(figure, spec):
    """The settings of a figure, its systems, and what decides on it: entries of the config by their paths."""
    asked, case = spec["request"], spec["request"]["case"]
    decides = {path: asked["settings"][name] for name, path in asked["paths"].items()}
    systems = {}
    if case:
        systems["system"] = decides[f"cases.{case}"] = system_of(case)
    if spec.get("systems"):
        systems["systems"] = decides["cases"] = all_systems()
    return {"figure": figure, "case": case, "settings": asked["settings"], "config": decides, **systems}


# The SPEC of every figure that the config makes.
MADE = made(config, specs())


def titled(case):
    """What words call the case of a figure, if it has one."""
    return {"case": title_of(config, case)} if case else {}


def caption(figure, spec):
    """The caption of a figure, with the numbers that it asks for."""
    case = spec["request"]["case"]
    known = CHAPTER.get(figure, {}) | (system_of(case) if case else config["system"]) | titled(case)
    return re.sub(r"\{(\w+)\}", lambda name: str(known.get(name[1], name[0])), spec["caption"])


# For `snakemake --report`.
config["captions"] = {name: spec["caption"] for name, spec in SPECS.items()}
config["captions"] |= {figure: caption(figure, spec) for figure, spec in MADE.items()}

for figure, spec in MADE.items():

    if "notebook" in spec:

        rule:
            name:
                figure
            input:
                **spec["request"]["inputs"],
                notebook=own(f"notebooks/{spec['notebook']}.ipynb"),
            output:
                **in_report(figure_files(f"results/figures/{figure}", spec), "Figures of the chapter"),
                html=f"results/notebooks/{figure}.html",
            params:
                **figure_params(figure, spec),
                scene=CHAPTER[figure] | titled(spec["request"]["case"]),
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
                **spec["request"]["inputs"],
            output:
                **in_report(figure_files(f"results/figures/{figure}", spec), "Companion figures"),
            params:
                **figure_params(figure, spec),
                code=FIGURES,
            log:
                f"results/logs/figures/{figure}.log",
            benchmark:
                f"results/benchmarks/figures/{figure}.tsv"
            script:
                "../scripts/figure.py"


def files_of_figures(of_notebooks):
    figures = {figure: spec for figure, spec in MADE.items() if ("notebook" in spec) == of_notebooks}
    return [
        path for figure, spec in figures.items() for path in figure_files(f"results/figures/{figure}", spec).values()
    ]


rule figures:
    input:
        files_of_figures(of_notebooks=True),


rule companions:
    input:
        files_of_figures(of_notebooks=False),
