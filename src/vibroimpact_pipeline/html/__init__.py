"""Parts of offline HTML pages: formulas, figure texts, notebooks and the content security policy."""
