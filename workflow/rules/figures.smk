# Each figure of the chapter has a rule of the same name, and a module of the same name in src/vibroimpact/figures.
# `snakemake --cores 2 fig10_06` makes one figure and its inputs.

# SCENES contains the config entry of each figure, keyed by name. The rules of the studies add further figures.
SCENES = dict(config["figures"])

POINTS = {"points": "results/fixed_points/{case}.csv"}
MOTION = {
    "samples": "results/simulations/{case}/{model}/samples.csv",
    "events": "results/simulations/{case}/{model}/events.csv",
}
# READ lists, for each notebook, the results that the notebook reads in addition to the files of its figure.
ORBITS = {"orbits": "results/orbits/{case}.csv"}
READ = {
    "fixed_points": POINTS | ORBITS,
    "theoretical_response": POINTS | ORBITS,
    "simulation": POINTS | MOTION | {"summary": "results/simulations/{case}/{model}/summary.json"},
}


rule fig10_01:
    output:
        **files("fig10_01"),
    params:
        **scene("fig10_01"),
    priority: 10
    script:
        "../scripts/figure.py"


use rule fig10_01 as fig10_02 with:
    output:
        **files("fig10_02"),
    params:
        **scene("fig10_02"),


use rule fig10_01 as fig10_03 with:
    output:
        **files("fig10_03"),
    params:
        **scene("fig10_03"),


use rule fig10_01 as fig10_04 with:
    output:
        **files("fig10_04"),
    params:
        **scene("fig10_04", "system.kappa"),


use rule fig10_01 as fig10_05 with:
    output:
        **files("fig10_05"),
    params:
        **scene("fig10_05"),


use rule fig10_01 as fig10_06 with:
    input:
        **of_case("fig10_06", POINTS),
    output:
        **files("fig10_06"),
    params:
        **scene("fig10_06"),


use rule fig10_01 as fig10_07 with:
    input:
        **of_case("fig10_07", POINTS),
    output:
        **files("fig10_07"),
    params:
        **scene("fig10_07"),


use rule fig10_01 as fig10_08 with:
    input:
        **of_case("fig10_08", MOTION),
    output:
        **files("fig10_08"),
    params:
        **scene("fig10_08"),


use rule fig10_01 as fig10_09 with:
    input:
        **of_case("fig10_09", POINTS),
    output:
        **files("fig10_09"),
    params:
        **scene("fig10_09"),


use rule fig10_01 as fig10_10 with:
    input:
        **of_case("fig10_10", POINTS),
    output:
        **files("fig10_10"),
    params:
        **scene("fig10_10"),


use rule fig10_01 as fig10_11 with:
    input:
        **of_case("fig10_11", MOTION),
    output:
        **files("fig10_11"),
    params:
        **scene("fig10_11"),


# The config can define further figures. Each of these figures is drawn like a figure of the chapter.
for figure in (name for name, own_scene in config["figures"].items() if "like" in own_scene):

    rule:
        name:
            figure
        input:
            **of_case(figure, MOTION if SCENES[figure]["like"] == "fig10_08" else POINTS),
        output:
            **files(figure),
        params:
            **scene(figure),
        priority: 10
        script:
            "../scripts/figure.py"


# ALL_FIGURES lists the figures that have a caption. The rules of the studies add further figures.
ALL_FIGURES = list(config["figures"])

if STUDIES:

    include: "studies/figures.smk"


config["captions"] = {name: words["caption"] for name, words in SPECS.items()}
config["captions"] |= {figure: caption(figure) for figure in ALL_FIGURES}

# Each notebook has one job. The job executes the notebook once for each figure that the notebook explains.
for path in sorted((ROOT / "notebooks").rglob("*.ipynb")):
    notebook = path.relative_to(ROOT).as_posix()
    shown = [figure for figure in SCENES if spec(figure).get("notebook") == path.stem]
    if shown:

        rule:
            name:
                f"pages_{path.stem}"
            input:
                notebook=checkout_path(notebook),
                read=sorted({file for figure in shown for file in page_inputs(figure).values()}),
            output:
                **{figure: f"results/notebooks/{figure}.html" for figure in shown},
            params:
                pages={figure: page_params(figure) for figure in shown},
                code=code("notebook", notebook, *(spec(figure)["module"] for figure in shown)),
            script:
                "../scripts/notebook.py"


rule figures:
    input:
        [getattr(rules, figure).output for figure in config["figures"]],
        expand("results/notebooks/{figure}.html", figure=config["figures"]),
