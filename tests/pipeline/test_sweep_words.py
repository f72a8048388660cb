"""A sweep in words: every form that an axis may have in the config."""

import pytest

from vibroimpact_pipeline.sweeps.words import axis_words


@pytest.mark.parametrize(
    ("axis", "words"),
    [
        ({"along": ["kappa"], "range": [0.5, 0.7], "values": 5}, "kappa: 5 values from 0.5 to 0.7, linear"),
        ({"along": ["f10_hat"], "range": [0.0, 1.6], "cells": 30}, "f10_hat: centres of 30 cells from 0 to 1.6"),
        ({"along": ["f10_hat", "f20_hat"], "listed": [0.5, 0.8]}, "f10_hat, f20_hat: [0.5, 0.8]"),
        ({"along": ["f10_hat", "kappa"], "tuples": [[0.4, 0.5], [0, 0.6]]}, "f10_hat, kappa: [[0.4, 0.5], [0, 0.6]]"),
    ],
)
def test_an_axis_is_told_as_the_config_has_it(axis, words):
    assert axis_words(axis) == words
