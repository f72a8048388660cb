"""The scenes in which ensembles are timed."""

from vibroimpact.accuracy.benchmark import scenes


def test_scenes_are_as_they_are_called():
    for name, (_, states, cycles) in scenes().items():
        counts = [int(word) for word in name.replace(",", "").split() if word.isdigit()]
        assert len(states) == (counts[0] * counts[1] if "systems" in name else counts[0]), name
        assert cycles == counts[-1], name
