"""Content security policy of the pages: show files beside a page, run the scripts beside it only.

Texts from the config and from results are escaped where a page is made; this holds should one of them slip through.
"""

import base64
import hashlib
import re

FILES = "'self' file:"
"""This site, and this disk: some browsers treat a page opened from disk as of no site."""
HEAD = re.compile(r"<head>\n?")


def policy(*scripts: str) -> str:
    """Return the element of the head that allows scripts from files and those within the page that are given."""
    digests = (base64.b64encode(hashlib.sha256(text.encode()).digest()).decode() for text in scripts)
    allowed = " ".join([FILES, *(f"'sha256-{digest}'" for digest in digests)]) if scripts else "'none'"
    rules = (
        f"default-src 'none'; img-src {FILES} data:; style-src {FILES} 'unsafe-inline'; font-src data:; "
        f"script-src {allowed}; base-uri 'none'; form-action {FILES}"
    )
    return f'<meta http-equiv="Content-Security-Policy" content="{rules}">'


def guarded(page: str) -> str:
    """Return a page that runs no script.

    Raises:
        ValueError: the page has no head.
    """
    page, found = HEAD.subn(f"<head>\n{policy()}\n", page, count=1)
    if not found:
        raise ValueError("page: has no head to say in what it may do")
    return page
