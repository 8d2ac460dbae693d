"""Hostile inputs: corpus, fuzzers, kill tests and soak; see docs/security.md."""
