"""Measures from elsewhere: functions, commands and peer packages, run on the rocks of a view.

Names are imported when they are first asked for: the process of a function needs few of them.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
