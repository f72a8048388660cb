# The figures of the config. Each has a rule of its name: `snakemake --cores 2 fig10_06` makes this figure and what it needs.
# Its notebook gets the inputs, and as parameters the settings of the config and the system of the case.

# Settings of each figure by its name; those of the studies join.
SCENES = dict(config["figures"])

# What figures show of a case.
POINTS = {
    "points": "results/fixed_points/{case}.csv",
    "verdicts": "results/verdicts/{case}.csv",
    "orbits": "results/orbits/{case}.csv",
}
MOTION = {
    "points": "results/fixed_points/{case}.csv",
    "samples": "results/simulations/{case}/{model}/samples.csv",
    "events": "results/simulations/{case}/{model}/events.csv",
    "summary": "results/simulations/{case}/{model}/summary.json",
}
RUN = ("cases.{case}.simulation.*",)


rule fig10_01:
    input:
        notebook=own("notebooks/drawings.ipynb"),
    output:
        **page_and_files("fig10_01"),
    params:
        **scene("fig10_01"),
    priority: 10
    log:
        "results/logs/figures/fig10_01.log",
    benchmark:
        "results/benchmarks/figures/fig10_01.tsv"
    conda:
        "../envs/vibroimpact.yaml"
    script:
        "../scripts/notebook.py"


use rule fig10_01 as fig10_02 with:
    input:
        notebook=own("notebooks/drawings.ipynb"),
    output:
        **page_and_files("fig10_02"),
    params:
        **scene("fig10_02"),
    log:
        "results/logs/figures/fig10_02.log",
    benchmark:
        "results/benchmarks/figures/fig10_02.tsv"


rule fig10_03:
    input:
        notebook=own("notebooks/closed_form.ipynb"),
    output:
        **page_and_files("fig10_03"),
    params:
        **scene("fig10_03"),
    priority: 10
    log:
        "results/logs/figures/fig10_03.log",
    benchmark:
        "results/benchmarks/figures/fig10_03.tsv"
    conda:
        "../envs/vibroimpact.yaml"
    script:
        "../scripts/notebook.py"


use rule fig10_03 as fig10_04 with:
    input:
        notebook=own("notebooks/closed_form.ipynb"),
    output:
        **page_and_files("fig10_04"),
    params:
        **scene("fig10_04", "system.kappa"),
    log:
        "results/logs/figures/fig10_04.log",
    benchmark:
        "results/benchmarks/figures/fig10_04.tsv"


use rule fig10_03 as fig10_05 with:
    input:
        notebook=own("notebooks/closed_form.ipynb"),
    output:
        **page_and_files("fig10_05"),
    params:
        **scene("fig10_05"),
    log:
        "results/logs/figures/fig10_05.log",
    benchmark:
        "results/benchmarks/figures/fig10_05.tsv"


rule fig10_06:
    input:
        **of_case("fig10_06", POINTS),
        notebook=own("notebooks/fixed_points.ipynb"),
    output:
        **page_and_files("fig10_06"),
    params:
        **scene("fig10_06"),
    priority: 10
    log:
        "results/logs/figures/fig10_06.log",
    benchmark:
        "results/benchmarks/figures/fig10_06.tsv"
    conda:
        "../envs/vibroimpact.yaml"
    script:
        "../scripts/notebook.py"


rule fig10_07:
    input:
        **of_case("fig10_07", POINTS),
        notebook=own("notebooks/theoretical_response.ipynb"),
    output:
        **page_and_files("fig10_07"),
    params:
        **scene("fig10_07"),
    priority: 10
    log:
        "results/logs/figures/fig10_07.log",
    benchmark:
        "results/benchmarks/figures/fig10_07.tsv"
    conda:
        "../envs/vibroimpact.yaml"
    script:
        "../scripts/notebook.py"


rule fig10_08:
    input:
        **of_case("fig10_08", MOTION),
        notebook=own("notebooks/simulation.ipynb"),
    output:
        **page_and_files("fig10_08"),
    params:
        **scene("fig10_08", *RUN),
    priority: 10
    log:
        "results/logs/figures/fig10_08.log",
    benchmark:
        "results/benchmarks/figures/fig10_08.tsv"
    conda:
        "../envs/vibroimpact.yaml"
    script:
        "../scripts/notebook.py"


use rule fig10_06 as fig10_09 with:
    input:
        **of_case("fig10_09", POINTS),
        notebook=own("notebooks/fixed_points.ipynb"),
    output:
        **page_and_files("fig10_09"),
    params:
        **scene("fig10_09"),
    log:
        "results/logs/figures/fig10_09.log",
    benchmark:
        "results/benchmarks/figures/fig10_09.tsv"


use rule fig10_07 as fig10_10 with:
    input:
        **of_case("fig10_10", POINTS),
        notebook=own("notebooks/theoretical_response.ipynb"),
    output:
        **page_and_files("fig10_10"),
    params:
        **scene("fig10_10"),
    log:
        "results/logs/figures/fig10_10.log",
    benchmark:
        "results/benchmarks/figures/fig10_10.tsv"


use rule fig10_08 as fig10_11 with:
    input:
        **of_case("fig10_11", MOTION),
        notebook=own("notebooks/simulation.ipynb"),
    output:
        **page_and_files("fig10_11"),
    params:
        **scene("fig10_11", *RUN),
    log:
        "results/logs/figures/fig10_11.log",
    benchmark:
        "results/benchmarks/figures/fig10_11.tsv"


# Your own figures of the config, by notebook: what they read, and settings beside their own.
OWN = {
    "fixed_points": (POINTS, ()),
    "theoretical_response": (POINTS, ()),
    "simulation": (MOTION, RUN),
}
OWN_FIGURES = [figure for figure in config["figures"] if not figure.startswith("fig10_")]

for figure in OWN_FIGURES:
    notebook = config["figures"][figure]["notebook"]
    read, settings = OWN[notebook]

    rule:
        name:
            figure
        input:
            **of_case(figure, read),
            notebook=own(NOTEBOOKS[notebook]),
        output:
            **page_and_files(figure),
        params:
            **scene(figure, *settings),
        priority: 10
        log:
            f"results/logs/figures/{figure}.log",
        benchmark:
            f"results/benchmarks/figures/{figure}.tsv"
        conda:
            "../envs/vibroimpact.yaml"
        script:
            "../scripts/notebook.py"


rule figures:
    input:
        [getattr(rules, figure).output for figure in config["figures"]],


# The figures that are compared with a reference set and that captions are for; those of the studies join.
ALL_FIGURES = list(config["figures"])
config["captions"] = {name: words["caption"] for name, words in SPECS.items()}
config["captions"] |= {figure: caption(figure) for figure in ALL_FIGURES}
