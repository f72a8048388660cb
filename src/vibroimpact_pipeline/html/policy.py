"""Content security policy of the pages: load files and scripts of the site only.

Texts from the config and from results are escaped when a page is made. The policy is a second line of defence.
"""

import base64
import hashlib
import re

FILES = "'self' file:"
"""The site and local files, because some browsers treat a local page as having no origin."""
HEAD = re.compile(r"<head>\n?")


def policy(*scripts: str) -> str:
    """Return the meta element that allows scripts from files and the given inline scripts."""
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
        If the page has no head element.
    """
    page, found = HEAD.subn(f"<head>\n{policy()}\n", page, count=1)
    if not found:
        raise ValueError("page: has no <head>, expected one for the content security policy")
    return page
