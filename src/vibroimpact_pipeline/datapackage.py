"""Make the data package (Frictionless Table Schema) of a build: its tables as the data dictionary describes them."""

from pathlib import Path

from vibroimpact_pipeline.data_dictionary import File

BLANKS = ["", "NA"]
TYPES = {
    "text": {"type": "string"},
    "true or false": {"type": "boolean", "trueValues": ["True"], "falseValues": ["False"]},
}
"""Type of a column by its unit; a column with any other unit is a number."""


def data_package(headers: dict[str, list[str]], known: list[File], units: dict[str, str], cited: dict) -> dict:
    """Return the data package for CSV files as JSON data.

    Parameters
    ----------
    headers
        Names of the columns of each table, by the path of the table. Paths begin with results/, the folder of the data
        package.
    known
        Kinds of results files.
    units
        Meaning of each unit.
    cited
        Content of CITATION.cff.

    Raises
    ------
    LookupError
        If the data dictionary lacks a table or one of its columns.
    """
    return {
        "profile": "tabular-data-package",
        "name": "vibroimpact",
        "title": cited["title"],
        "description": cited["abstract"],
        "version": str(cited["version"]),
        "keywords": cited["keywords"],
        "licenses": [{"name": cited["license"], "path": f"https://spdx.org/licenses/{cited['license']}"}],
        "contributors": [{"title": author["name"], "role": "author"} for author in cited["authors"]],
        "resources": [_resource(path, header, known, units) for path, header in sorted(headers.items())],
    }


def _resource(path, header, known, units):
    about, columns = next(((file.about, file.columns) for file in known if file.has(path)), ("", {}))
    if missing := [name for name in header if name not in columns]:
        raise LookupError(f"{path}: columns missing in the data dictionary: {', '.join(missing)}")
    below = path.removeprefix("results/")
    return {
        "profile": "tabular-data-resource",
        "name": str(Path(below).with_suffix("")).lower().replace("/", "."),
        "path": below,
        "description": about,
        "format": "csv",
        "mediatype": "text/csv",
        "encoding": "utf-8",
        "schema": {
            "fields": [_field(name, columns[name], units) for name in header],
            "missingValues": BLANKS,
        },
    }


def _field(name, entry, units):
    field = {"name": name, **TYPES.get(entry["unit"], {"type": "number"}), "description": entry["meaning"]}
    if entry["unit"] not in TYPES:
        field |= {"unit": entry["unit"], "unitDescription": units[entry["unit"]]}
    if entry.get("values"):
        field["constraints"] = {"enum": entry["values"]}
    return field
