from chapter_figures import lightness, points_of, run_of, scenes, system  # noqa: F401 (fixtures)
