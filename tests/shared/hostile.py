"""Texts that try to inject markup or scripts, and checks for active content on a page."""

import re
from html.parser import HTMLParser
from urllib.parse import urlsplit

RUN = "void(document.title='taken')"
HOSTILE = (
    "\"'><script>RUN</script> <img src=x onerror=RUN> [x](javascript:RUN) ![y](http://127.0.0.1:9/y) "
    r"`a``<marquee onclick=RUN>` `b`{=html} {#id onclick=RUN} | ::: *c* **d** $e$ \( \end{x} #read('x') "
    "&lt; </script> --> {{ 7 * 7 }} {% if %}"
).replace("RUN", RUN)
"""Text that would end attributes, elements, code, cells and formulas in HTML, Markdown, TeX, Typst and templates."""
STATEMENT = (
    f"Words of the repository, with $C_1$; what is live in them is none: <script>{RUN}</script> [x](javascript:{RUN})"
)
"""Hostile text in Markdown, as it could occur in claims and notebooks."""
DATA = {"type": "application/json"}
KINDS = ("iframe", "object", "embed", "base", "form", "marquee")
"""Elements that no page contains by itself."""
MARKS = (
    "<!-- ¦ &amp; ¦ &#60;b> ¦ a\n\n# b ¦ - a ¦ 1. a ¦ > a ¦ ```\n<b>\n``` ¦ ~~~ ¦ [a]: b ¦ <http://a.b> ¦ a@b.c ¦ "
    "\\<b> ¦ \\\\(x\\\\) ¦ $x$ ¦ $$x$$ ¦ ^a^ ¦ ~a~ ¦ ::: ¦ --- ¦ a  \nb ¦ | ¦ +-+ ¦ é — ² ¦ @a [@b] ¦ [^1]"
)
TEXTS = [HOSTILE, *(HOSTILE[start : start + 25] for start in range(0, len(HOSTILE), 9)), *MARKS.split(" ¦ ")]


class Markup(HTMLParser):
    """Parsed page: elements, attributes with scripts, targets of links, texts, and content security policy."""

    def __init__(self, html: str):
        super().__init__()
        self.elements, self.programs, self.links, self.texts, self.policy = [], [], [], [], ""
        self.feed(html)

    @property
    def text(self) -> str:
        return " ".join("".join(self.texts).split())

    def handle_starttag(self, tag, attrs):
        values = dict(attrs)
        self.elements.append((tag, values))
        self.programs += [name for name in values if name.startswith("on") or name == "srcdoc"]
        names = ("href", "src", "srcset", "action", "formaction", "data", "poster")
        self.links += [values[name] for name in names if values.get(name)]
        if values.get("http-equiv") == "Content-Security-Policy":
            self.policy = values["content"]

    def handle_data(self, data):
        self.texts.append(data)


def assert_nothing_is_live(markup, scripts=0):
    """Check that a page has only its own elements, attributes and links, and a policy that lets nothing else run."""
    odd = [values for tag, values in markup.elements if tag in KINDS]
    assert [values for values in odd if values.get("action") != "search.html"] == []
    programs = [values for tag, values in markup.elements if tag == "script" and not values.items() >= DATA.items()]
    assert [values for values in programs if not values.get("src", "").startswith("_static/")] == [{}] * scripts
    assert markup.programs == []
    assert {urlsplit(link).scheme for link in markup.links} <= {"", "data"}
    assert [values for tag, values in markup.elements if tag == "img" and values["src"] == "x"] == []
    assert re.search(r"script-src ('none'|'self' file: 'sha256-[^']{44}');", markup.policy)
    assert markup.policy.startswith("default-src 'none'; ")
