# The report: one site that reads offline and one PDF, from the results of all stages.

REPORT_SETTINGS = yaml.safe_load((ROOT / "report/report.yaml").read_text(encoding="utf-8"))
REPORT_SHOWS = {
    "chapter": list(config["figures"]),
    "companions": list(COMPANIONS),
    "accuracy": ["work_precision", "hazards"],
    "models": ["scene_models"],
    "animations": list(REPORT_SETTINGS["animations"]),
    "travel": ["travel"],
}
REPORT_TABLES = [
    "results/fixed_points.csv",
    "results/orbits.csv",
    *["results/claims.json"] * claims_apply(),
    *(path for companion in COMPANIONS.values() for path in companion.get("tables", {}).values()),
]
PICTURES = "png", "pdf", "svg"


for name, scene in REPORT_SETTINGS["animations"].items():

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


rule travel:
    output:
        **in_report({kind: f"results/travel/travel.{kind}" for kind in ("csv", *PICTURES)}, "Fixed points"),
        json="results/travel/travel.json",
    params:
        system=system_of(REPORT_SETTINGS["travel"]["case"]),
        settings=REPORT_SETTINGS["travel"],
        code=code("workflow/scripts/travel.py"),
    log:
        "results/logs/report/travel.log",
    benchmark:
        "results/benchmarks/report/travel.tsv"
    script:
        "../scripts/travel.py"


rule report:
    input:
        rules.figures.input,
        rules.companions.input,
        rules.stability.input,
        rules.accuracy.input,
        rules.travel.output,
        [path for name in REPORT_SETTINGS["animations"] for path in getattr(rules, name).output],
        [own(page["source"]) for page in REPORT_SETTINGS["pages"]],
        sorted(own(str(path.relative_to(ROOT))) for path in (ROOT / "report").rglob("*") if path.is_file()),
        tables=REPORT_TABLES,
    output:
        directory("results/report"),
    params:
        shown=REPORT_SHOWS,
        config={name: config[name] for name in ("system", "cases")},
        code=code("workflow/scripts/report.py"),
    log:
        "results/logs/report/report.log",
    benchmark:
        "results/benchmarks/report/report.tsv"
    script:
        "../scripts/report.py"
