"""The sub-commands that rockshape itself brings."""
