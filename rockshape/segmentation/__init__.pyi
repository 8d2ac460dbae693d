from .edges.edge_snapping import SnappedOutline as SnappedOutline
from .finders import FINDERS as FINDERS
from .finders import Finder as Finder
from .finders import find_finder as find_finder
from .finders import finders as finders
from .result import Branch as Branch
from .result import FoundRock as FoundRock
from .result import Segmentation as Segmentation
