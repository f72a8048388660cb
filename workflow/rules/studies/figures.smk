# Companion figures. Each has a rule of the same name and a module in src/vibroimpact/studies/figures/.


include: "common.smk"


# Each figure has an entry with some of the following keys. The first four select arguments of its function `compute`:
# - case: path of the config entry that names a case. The system of this case is an argument.
# - systems: If True, the systems of all cases are an argument.
# - settings: paths of config entries. Each entry is an argument with the name of the last key in its path. A * at the
#   end of a path stands for all keys except `case`.
# - inputs: paths of tables. Each table is an argument.
# - needs: paths of further config entries that the figure requires.
# - outputs: paths of the outputs, in place of the usual ones.
# A figure is omitted if the config lacks one of these config entries, or a sweep whose table is in `inputs`.
COMPANIONS = {
    "companion_10_08": {
        "case": "figures.fig10_08.case",
        "inputs": POINTS | MOTION,
    },
    "companion_absorber": {
        "case": "sweeps.clearance.case",
        "settings": [f"sweeps.clearance.{name}" for name in ("band", "seed", "cycles", "settle")],
        "inputs": {
            "response": "results/sweeps/frequency_response.csv",
            "clearance": "results/sweeps/clearance.csv",
            "design": "results/sweeps/design.csv",
        },
    },
    "companion_asymmetric": {
        "systems": True,
        "settings": ["system.kappa", "regimes.asymmetric.*"],
        "inputs": {"orbits": "results/orbits.csv"},
    },
    "companion_basins": {
        "case": "regimes.basins.case",
        "settings": ["regimes.basins.case", "regimes.basins.points", "regimes.observation"],
    },
    "companion_branches": {
        "case": "regimes.branches.case",
        "systems": True,
        "settings": ["regimes.branches.*", "regimes.observation"],
    },
    "companion_coupling": {"systems": True, "needs": ["cases.equal"]},
    "companion_epsilon": {"systems": True, "settings": ["regimes.epsilon.*"]},
    "companion_horizon": {
        "case": "figures.fig10_11.case",
        "settings": ["cases.{case}.simulation.initial_state"],
        "inputs": {"strobe": "results/simulations/{case}/reference/strobe.csv"},
        "needs": ["cases.{case}.simulation.digits"],
    },
    "companion_regime_map": {
        "case": "sweeps.regime_map.case",
        "systems": True,
        "settings": ["sweeps.regime_map.starts"],
        "inputs": {"table": "results/sweeps/regime_map.csv"},
    },
    "companion_response": {
        "case": "sweeps.frequency_response.case",
        "settings": ["sweeps.clearance.band"],
        "inputs": {"frequency": "results/sweeps/frequency_response.csv", "force": "results/sweeps/clearance.csv"},
    },
    "nudge": {
        "case": "figures.fig10_06.case",
        "outputs": figure_files("results/nudge/nudge", {})
        | {kind: f"results/nudge/nudge.{kind}" for kind in ("json", "gif")},
    },
}


# Each machine in the config (in SI units) has a companion figure and a page.
for name in config["machines"]:
    SCENES[name] = config["machines"][name] | {"like": "machines"}
    COMPANIONS[name] = {"settings": [f"machines.{name}.*"]}

STUDY_FIGURES = {figure: found for figure, takes in COMPANIONS.items() if (found := companion(figure, **takes))}

for figure, found in STUDY_FIGURES.items():

    rule:
        name:
            figure
        input:
            **found.inputs,
        output:
            **found.outputs,
        params:
            **found.params,
        script:
            "../../scripts/figure.py"


ALL_FIGURES += STUDY_FIGURES
# Figures with a reference picture: all but `nudge`, the picture at the head of the article.
STUDY_DRAWINGS = [figure for figure in STUDY_FIGURES if figure != "nudge"]


rule companions:
    input:
        [getattr(rules, figure).output for figure in STUDY_FIGURES],
        expand("results/notebooks/{machine}.html", machine=config["machines"]),
