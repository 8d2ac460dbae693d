"""File input and output: one registry of formats, a reader and a writer for each kind of file."""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
