"""The chapter's claims, each judged by a check that computes."""
