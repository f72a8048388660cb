# Figures that the chapter does not show. One entry makes the rule; it bears the figure's name, and so does the module
# that draws it (vibroimpact.figures.companions.<name>). `method` says how, `settings` gives each argument of its
# `compute` a place in the config, `system` or `systems` the system of one case or those of all; `inputs` are tables
# it reads, made by the steps `before`; `tables` are tables it writes beside the one it plots. `config` names what
# else decides on it.

SIMULATED = "direct integration of (10.1) from many starts, until it repeats"


def keys_of(section, *without):
    """Every key of a section of the config as an argument."""
    return {key: f"{section}.{key}" for key in config_at(section) if key not in without}


def horizon_of(case):
    """Of the first case that is computed with many digits, where float64 leaves it."""
    simulation = f"cases.{case}.simulation"
    return {
        "method": "the same in float64, and the error that the certificate of every run expects",
        "system": case,
        "settings": {"state": f"{simulation}.initial_state", "transient_cycles": f"{simulation}.transient_cycles"},
        "config": [simulation],
        "inputs": {"strobe": f"results/simulations/{case}/strobe.csv"},
        "before": [simulation_step(case)],
    }


def motions_of(case):
    """Of a simulated case: what the theory says of it, and what happens."""
    simulation = f"results/simulations/{case}"
    return {
        "method": "(10.10) at the fixed point nearest to the simulated motion, and that motion",
        "system": case,
        "inputs": {"points": f"results/fixed_points/{case}.csv"}
        | {table: f"{simulation}/{table}.csv" for table in ("samples", "events")},
        "before": [step(*STEPS["fixed_points"]), simulation_step(case)],
        "config": [f"cases.{case}.simulation"],
    }


def gaps_of(case):
    """Of a simulated case: its motion, and where its second ball is out of resonance."""
    tables = {table: f"results/simulations/{case}/{table}.csv" for table in ("samples", "events")}
    return {
        "method": "resonant bursts between the impacts of the simulation",
        "system": case,
        "inputs": tables,
        "before": [simulation_step(case)],
        "config": [f"cases.{case}.simulation"],
    }


def map_of(sweep):
    """The figure of a sweep over both forces."""
    return {
        "method": "the points of a sweep, with the cases; borders of the theory by bisection",
        "systems": True,
        "settings": {"starts": f"sweeps.{sweep}.starts"},
        "config": sweep_keys(sweep),
        "inputs": {"table": table_of(sweep)},
        "before": [step(*STEPS["tile_of_sweep"])],
    }


def response_of(frequency, clearance):
    """The figure of frequency and force responses, of two sweeps: a clearance is a force."""
    tables = {"frequency": frequency, "force": clearance}
    return {
        "method": "the points of two sweeps; fixed points, exact symmetric orbits and linear systems in closed form",
        "system": SWEEPS[frequency]["case"],
        "settings": {"band": f"sweeps.{clearance}.band"},
        "config": [key for name in tables.values() for key in sweep_keys(name)],
        "inputs": {table: table_of(name) for table, name in tables.items()},
        "before": [step(*STEPS["tile_of_sweep"])],
        "tables": {"shares": "results/impact_shares.csv"},
    }


def absorber_of(response, clearance, design):
    """The figure of the best clearance and restitution, of three sweeps."""
    tables = {"response": response, "clearance": clearance, "design": design}
    sweep = f"sweeps.{clearance}"
    return {
        "method": "the points of three sweeps; linear systems in closed form, absorbers tuned by optimisation",
        "system": SWEEPS[clearance]["case"],
        "settings": {name: f"{sweep}.{name}" for name in ("band", "seed", "cycles", "settle")}
        | {"number": f"{sweep}.starts"}
        | OBSERVED,
        "config": [key for name in tables.values() for key in sweep_keys(name)],
        "inputs": {table: table_of(name) for table, name in tables.items()},
        "before": [step(*STEPS["tile_of_sweep"])],
        "tables": {"summary": "results/absorber.csv"},
    }


def decay_of(tuned_by):
    """The figure of free decay, its best absorbers those of the band of a sweep."""
    return {
        "method": "free flights in closed form between impacts; linear systems in closed form",
        "system": REGIMES["decay"]["case"],
        "settings": keys_of("regimes.decay", "case") | {"band": f"sweeps.{tuned_by}.band"},
        "config": ["regimes.decay.case"],
    }


PRECISE = [case for case in config["cases"] if exact(case)]
ABSORBER = ("frequency_response", "clearance", "design")
OBSERVED = {"observation": "regimes.observation"}
COMPANIONS = {
    "companion_10_04": {
        "method": "closed form: (10.16), (10.26), limits of Masri's analysis",
        "settings": {"kappa": "system.kappa", "C_max": "stability.companion_10_04.C_max"},
    },
    "companion_10_05": {
        "method": "closed form: (10.26), limits of Masri's analysis; penetration as a root",
        "settings": {"C_range": "stability.companion_10_05.C_range"},
    },
    **(
        {"companion_10_08": motions_of(config["figures"]["fig10_08"]["case"])}
        if "fig10_08" in config["figures"]
        else {}
    ),
    **({"companion_10_11": gaps_of(config["figures"]["fig10_11"]["case"])} if "fig10_11" in config["figures"] else {}),
    "companion_stability": {
        "method": "verdicts and places as computed, limits in closed form",
        "systems": True,
        "inputs": {"points": "results/fixed_points.csv", "orbits": "results/orbits.csv"},
        "before": [step(*STEPS[name]) for name in ("fixed_points", "orbits", "verdicts")],
    },
    **({"companion_horizon": horizon_of(PRECISE[0])} if PRECISE else {}),
    "companion_branches": {
        "method": f"continuation of fixed points and exact 1:1 responses; attractors by {SIMULATED}",
        "system": REGIMES["branches"]["case"],
        "systems": True,
        "settings": keys_of("regimes.branches", "case") | OBSERVED,
        "config": ["regimes.branches.case", "regimes.coexistence"],
        "inputs": {"lifetimes": rules.coexistence.output.lifetimes},
        "before": [step(*STEPS["coexistence"])],
        "tables": {
            "special_points": "results/regimes/special_points.csv",
            "onsets": "results/regimes/modulation_onsets.csv",
        },
    },
    **({"companion_regime_map": map_of("regime_map")} if "regime_map" in SWEEPS else {}),
    **({"companion_response": response_of(*ABSORBER[:2])} if {*ABSORBER[:2]} <= {*SWEEPS} else {}),
    **({"companion_absorber": absorber_of(*ABSORBER)} if {*ABSORBER} <= {*SWEEPS} else {}),
    **({"companion_decay": decay_of("clearance")} if "clearance" in SWEEPS else {}),
    "companion_modulation": {
        "method": f"{SIMULATED}; Lyapunov exponents along the linearised flow",
        "systems": True,
        "settings": keys_of("regimes.modulation") | OBSERVED,
        "tables": {
            "measures": "results/regimes/modulation.csv",
            "windows": "results/regimes/modulation_windows.csv",
            "spectra": "results/regimes/spectra.csv",
        },
    },
    "companion_basins": {
        "method": SIMULATED,
        "system": REGIMES["basins"]["case"],
        "settings": keys_of("regimes.basins") | OBSERVED,
        "tables": {"shares": "results/regimes/basin_shares.csv"},
    },
    "companion_epsilon": {
        "method": "fixed points and exact symmetric responses at every epsilon",
        "systems": True,
        "settings": keys_of("regimes.epsilon"),
        "tables": {"orders": "results/regimes/epsilon_orders.csv"},
    },
    "companion_ladder": {
        "method": "fixed points to leading and next order, N harmonics with exact receptances, exact symmetric responses",
        "systems": True,
        "settings": keys_of("regimes.ladder"),
        "tables": {
            "verdicts": "results/regimes/ladder_verdicts.csv",
            "limits": "results/regimes/ladder_limits.csv",
        },
    },
    "companion_asymmetric": {
        "method": "closed form, fixed points, and exact asymmetric responses followed to small epsilon",
        "systems": True,
        "settings": keys_of("regimes.asymmetric") | {"C_max": "stability.companion_10_04.C_max"},
        "inputs": {"orbits": "results/orbits.csv"},
        "before": [step(*STEPS["orbits"])],
        "tables": {"points": "results/asymmetric_fixed_points.csv", "relaxation": "results/regimes/relaxation.csv"},
    },
}


def companion_outputs(name):
    return figure_files(f"results/figures/{name}") | COMPANIONS[name].get("tables", {})


def companion_module(name):
    return f"vibroimpact.figures.companions.{name}"


def companion_settings(name):
    """Arguments of `compute`, systems as their parameters."""
    companion = COMPANIONS[name]
    system = {"system": system_of(companion["system"])} if "system" in companion else {}
    systems = {"systems": all_systems()} if "systems" in companion else {}
    return system | systems | {key: config_at(path) for key, path in companion.get("settings", {}).items()}


def companion_provenance(name):
    companion = COMPANIONS[name]
    cases = (
        sorted(config["cases"]) if "systems" in companion else [companion["system"]] if "system" in companion else []
    )
    keys = [*companion.get("settings", {}).values(), *companion.get("config", [])]
    own = step(companion["method"], DOUBLE, "workflow/scripts/companion.py", modules=[companion_module(name)])
    return provenance(name, keys, cases, [*companion.get("before", []), own])


for name, companion in COMPANIONS.items():

    rule:
        name:
            name
        input:
            **companion.get("inputs", {}),
        output:
            **in_report(companion_outputs(name), "Companion figures"),
        params:
            module=companion_module(name),
            settings=companion_settings(name),
            provenance=companion_provenance(name),
        log:
            f"results/logs/companions/{name}.log",
        benchmark:
            f"results/benchmarks/companions/{name}.tsv"
        script:
            "../scripts/companion.py"


rule companions:
    input:
        rules.coexistence.output,
        [table_of(name) for name in DRAWN if name in SWEEPS],
        [path for name in COMPANIONS for path in companion_outputs(name).values()],
