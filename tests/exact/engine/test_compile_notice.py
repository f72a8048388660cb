"""A word before something is compiled that takes long, once; `tests/test_package.py` hears it from a process."""

from types import SimpleNamespace

import pytest

from vibroimpact.exact.engine.compile_notice import ON_DEMAND, SIMULATION, _Notice
from vibroimpact.exact.engine.event_loop import integrate
from vibroimpact.exact.engine.flow import advance
from vibroimpact.exact.engine.flow_tables import tables
from vibroimpact.exact.engine.replay import replayed
from vibroimpact.rivals.right_hand_side import rates


@pytest.fixture
def said(capsys):
    """Tells a notice about compilations, one within the other, and returns what it says."""
    notice = _Notice()

    def tell(*functions):
        heard = [SimpleNamespace(data={"dispatcher": function}) for function in functions]
        for one in heard:
            notice.on_start(one)
        for one in reversed(heard):
            notice.on_end(one)
        return capsys.readouterr().err

    return tell


def test_the_simulation_and_what_comes_after_are_said_once_each(said):
    assert said(tables).count(SIMULATION) == 1
    assert said(integrate, advance) == ""
    assert said(replayed, advance).count(ON_DEMAND) == 1
    assert said(replayed) == ""


def test_what_others_compile_is_not_said(said):
    assert said(rates) == ""
    theirs = SimpleNamespace(py_func=SimpleNamespace(__module__="their.event_loop"))
    assert said(theirs, integrate) == ""
