"""One file to cite and to run elsewhere: sources, results and what describes both (RO-Crate, CodeMeta, CODECHECK)."""
