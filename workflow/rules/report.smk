# The report: one site that reads offline and one PDF, from the results of all stages.

import yaml

from vibroimpact_pipeline.report.api import documented

REPORT_SETTINGS = yaml.safe_load((ROOT / "report/report.yaml").read_text(encoding="utf-8"))
MOVING = config["report"]
REPORT_SHOWS = {
    "chapter": [figure for figure in config["figures"] if figure.startswith("fig10_")],
    "own": [figure for figure in config["figures"] if not figure.startswith("fig10_")],
    "companions": list(COMPANIONS),
    "accuracy": ["work_precision", "hazards"],
    "models": ["scene_models"],
    "animations": list(MOVING["animations"]),
    "force_sweep": ["force_sweep"],
}
REPORT_TABLES = [
    "results/fixed_points.csv",
    "results/orbits.csv",
    "results/claims.json",
    *(path for companion in COMPANIONS.values() for path in companion.get("tables", {}).values()),
]
PICTURES = "png", "pdf", "svg"
API_MODULES = documented(REPORT_SETTINGS["api"]["left_out"])


for name, scene in MOVING["animations"].items():

    rule:
        name:
            name
        input:
            samples=CASE_FILES["samples"].format(case=scene["case"]),
            events=CASE_FILES["events"].format(case=scene["case"]),
        output:
            **in_report({kind: f"results/animations/{name}.{kind}" for kind in PICTURES}, "The motion"),
            json=f"results/animations/{name}.json",
        params:
            system=system_of(scene["case"]),
            cycles=scene["cycles"],
            code=code("workflow/scripts/animation.py"),
        log:
            f"results/logs/report/{name}.log",
        benchmark:
            f"results/benchmarks/report/{name}.tsv"
        script:
            "../scripts/animation.py"


rule force_sweep:
    output:
        **in_report({kind: f"results/force_sweep/force_sweep.{kind}" for kind in ("csv", *PICTURES)}, "Fixed points"),
        json="results/force_sweep/force_sweep.json",
    params:
        system=system_of(MOVING["force_sweep"]["case"]),
        settings=MOVING["force_sweep"],
        code=code("workflow/scripts/force_sweep.py"),
    log:
        "results/logs/report/force_sweep.log",
    benchmark:
        "results/benchmarks/report/force_sweep.tsv"
    script:
        "../scripts/force_sweep.py"


rule api:
    input:
        [own(f"report/api/{name}") for name in ("module.html.jinja2", "custom.css")],
    output:
        directory("results/api"),
    params:
        modules=API_MODULES,
        code=code("workflow/scripts/api.py", modules=API_MODULES),
    log:
        "results/logs/report/api.log",
    benchmark:
        "results/benchmarks/report/api.tsv"
    script:
        "../scripts/api.py"


rule report:
    input:
        rules.api.output,
        rules.figures.input,
        rules.companions.input,
        rules.stability.input,
        rules.accuracy.input,
        rules.force_sweep.output,
        [path for name in MOVING["animations"] for path in getattr(rules, name).output],
        [own(page["source"]) for page in REPORT_SETTINGS["pages"]],
        sorted(own(str(path.relative_to(ROOT))) for path in (ROOT / "report").rglob("*") if path.is_file()),
        tables=REPORT_TABLES,
        onsets=rules.coexistence.output.onsets,
    output:
        directory("results/report"),
    params:
        shown=REPORT_SHOWS,
        config={name: config[name] for name in ("system", "cases", "figures", "report", "regimes")},
        departures=DEPARTURES,
        judged=not UNLIKE,
        code=code("workflow/scripts/report.py"),
    log:
        "results/logs/report/report.log",
    benchmark:
        "results/benchmarks/report/report.tsv"
    script:
        "../scripts/report.py"
