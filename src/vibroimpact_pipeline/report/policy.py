"""Content security policy of the pages: show files beside a page, run the report's own scripts only.

Texts from the config and from results are escaped where a page is made; this holds should one of them slip through.
"""

import base64
import hashlib
import re
from collections.abc import Callable

FILES = "'self' file:"
"""This site, and this disk: some browsers treat a page opened from disk as of no site."""
POLICY = (
    f"default-src 'none'; img-src {FILES} data:; style-src {FILES} 'unsafe-inline'; font-src data:; "
    f"script-src {{scripts}}; base-uri 'none'; form-action {FILES}"
)
HEAD = re.compile(r"<head>\n?")
SCRIPT = re.compile(r'<script src="([\w/]+\.js)"></script>')


def guarded(page: str, script: Callable[[str], str] | None = None, theme=()) -> str:
    """Return a page with its policy and its own scripts inside, since browsers check no script file by its content.

    Args:
        page: HTML with a head, and <script src="NAME.js"></script> where a script of the report belongs.
        script: the text of a script, by its name; without it the page has none.
        theme: texts of the scripts that the generator has put into the page.

    Raises:
        ValueError: the page has no head.
    """
    own = {name: script(name) for name in SCRIPT.findall(page)} if script else {}
    for name, text in own.items():
        page = page.replace(f'<script src="{name}"></script>', f"<script>{text}</script>", 1)
    allowed = " ".join(f"'sha256-{_digest(text)}'" for text in [*own.values(), *theme]) or "'none'"
    policy = POLICY.format(scripts=allowed)
    page, found = HEAD.subn(f'<head>\n<meta http-equiv="Content-Security-Policy" content="{policy}">\n', page, count=1)
    if not found:
        raise ValueError("page: has no head to say in what it may do")
    return page


def _digest(script):
    return base64.b64encode(hashlib.sha256(script.encode()).digest()).decode()
