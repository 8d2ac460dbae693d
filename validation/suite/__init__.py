"""Suites: experiments, sweeps and gates, read from TOML."""
