"""Lines for a user: on a terminal above one line that changes, in a file or a pipe plain and at once."""

import os
import sys
from typing import TextIO

STYLES = {"Failed": "\x1b[31m", "Not": "\x1b[31m", "Done": "\x1b[32m", "Open": "\x1b[1m"}
"""Colours by the word that a line begins with, so that none says anything alone."""
RESET = "\x1b[0m"
ERASE = "\r\x1b[K"


class Screen:
    """The lines on a stream. `live`: it is a terminal, where a line can change."""

    def __init__(self, stream: TextIO | None = None, colour: bool = True):
        self.stream = stream or sys.stderr
        self.live = self.stream.isatty() and os.environ.get("TERM") != "dumb"
        self.colour = colour and self.live and not os.environ.get("NO_COLOR")
        self._status = ""

    def say(self, *lines: str) -> None:
        """Print lines that stay."""
        if lines:
            self.status("")
        self.stream.writelines(f"{self._styled(line)}\n" for line in lines)
        self.stream.flush()

    def status(self, line: str) -> None:
        """Change the last line of a terminal; elsewhere nothing."""
        if self.live and line != self._status:
            self._status = line
            self.stream.write(ERASE + line[: self._width() - 1])
            self.stream.flush()

    def _styled(self, line):
        style = STYLES.get(line.partition(" ")[0].rstrip(":")) if self.colour else None
        return f"{style}{line}{RESET}" if style else line

    def _width(self):
        return os.get_terminal_size(self.stream.fileno()).columns or 80
