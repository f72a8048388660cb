# The index page shows the figures and links to all results, including those of the studies.


rule index:
    input:
        rules.figures.input,
        rules.gather.output,
        rules.accuracy.input,
    output:
        html="results/index.html",
    params:
        config={name: config[name] for name in ("system", "cases", "figures")},
        charts=ALL_CHARTS,
        studies=study_titles,
        code=code("index", "report/data.yaml", *map(module_of, SPECS)),
    script:
        "../scripts/index.py"
