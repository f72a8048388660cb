"""Nothing wrong is called right: code that was changed while it ran, files that are not what was written."""
