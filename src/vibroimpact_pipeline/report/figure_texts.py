"""What is said of each figure and table, as report/figures.yaml has it: title, caption, alternative text, equations."""

import re
from pathlib import Path

import yaml


def figure_texts(root, cases: dict) -> dict[str, dict]:
    """The entries by name; captions (reStructuredText) with the numbers of cases they ask for: {equal.f10_hat}, say."""
    texts = yaml.safe_load((Path(root) / "report/figures.yaml").read_text(encoding="utf-8"))
    for entry in texts.values():
        entry["caption"] = re.sub(
            r"\{(\w+)\.(\w+)\}", lambda number: str(cases[number[1]][number[2]]), entry["caption"]
        )
    return texts
