# One job per figure, whose rule bears its name: `snakemake --cores 2 fig10_06` builds this figure and what it needs.
# What a figure reads says its SPEC in src/vibroimpact/figures/<figure>.py; a notebook draws those of the chapter.

CHAPTER = config["figures"]

# The SPEC of every figure that the config makes.
MADE = made(config, specs())

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
                code=PIPELINE | fingerprints(f"notebooks/{spec['notebook']}.ipynb"),
            priority: 10
            log:
                f"results/logs/figures/{figure}.log",
            benchmark:
                f"results/benchmarks/figures/{figure}.tsv"
            conda:
                "../envs/vibroimpact.yaml"
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
            conda:
                "../envs/vibroimpact.yaml"
            script:
                "../scripts/figure.py"


rule figures:
    input:
        files_of_figures(of_notebooks=True),


rule companions:
    input:
        files_of_figures(of_notebooks=False),
