# Build the report from the results of all stages. The report is an offline website with a PDF.


rule report:
    input:
        rules.figures.input,
        rules.companions.input,
        rules.stability.input,
        rules.accuracy.input,
        rules.claims.output,
    output:
        site=directory("results/report"),
    params:
        figures=ALL_FIGURES,
        charts=ALL_CHARTS,
        tables=sorted(
            {table["file"] for one in ALL_FIGURES for name, table in spec(one)["tables"].items() if name != "csv"}
        ),
        config={name: config[name] for name in ("system", "cases", "figures", "regimes", "stability", "sweeps")},
        code=code("studies/report", "development.lock", "docs", "report", "src/vibroimpact"),
    script:
        "../../scripts/studies/report.py"
