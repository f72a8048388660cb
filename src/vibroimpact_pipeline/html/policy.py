"""Add a content security policy to pages, so that they load only files of the site.

The policy is a second protection, since texts from config and results are already escaped.
"""

import base64
import hashlib
import re
from pathlib import Path

from jinja2 import Environment

FILES = "'self' file:"
"""Allowed sources: the site itself, and local files because some browsers assign no origin to a local page."""
HEAD = re.compile(r"<head>\n?")


def policy(*scripts: str) -> str:
    """Return the policy as an HTML meta element.

    If inline `scripts` are given, the policy allows these scripts and all script files of the site. If no inline script
    is given, the policy allows no script.
    """
    digests = (base64.b64encode(hashlib.sha256(text.encode()).digest()).decode() for text in scripts)
    allowed = " ".join([FILES, *(f"'sha256-{digest}'" for digest in digests)]) if scripts else "'none'"
    rules = (
        f"default-src 'none'; img-src {FILES} data:; style-src {FILES} 'unsafe-inline'; font-src data:; "
        f"script-src {allowed}; base-uri 'none'; form-action {FILES}"
    )
    return f'<meta http-equiv="Content-Security-Policy" content="{rules}">'


def guarded(page: str) -> str:
    """Return a page with a policy that allows no script.

    Raises
    ------
    ValueError
        If the page has no head.
    """
    page, found = HEAD.subn(f"<head>\n{policy()}\n", page, count=1)
    if not found:
        raise ValueError("page: has no <head>, expected one for the content security policy")
    return page


def rendered(template: Path, **values) -> str:
    """Fill a Jinja template with values and return the page.

    The values are escaped. The policy of the page allows no script.
    """
    environment = Environment(autoescape=True, trim_blocks=True, lstrip_blocks=True)
    return guarded(environment.from_string(template.read_text(encoding="utf-8")).render(values))
