"""Execution: units of work, executors, the result store and the code fingerprint."""
