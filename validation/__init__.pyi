from .api import compare as compare
from .api import run as run
from .api import score as score
from .errors import InputError as InputError
from .errors import MissingPackageError as MissingPackageError
from .errors import WorkerError as WorkerError
from .execution.suite_result import SuiteResult as SuiteResult
from .records.view_score import ViewScore as ViewScore
from .suite.gates import Gate as Gate
from .suite.shipped import suite_names as suite_names
from .suite.suite import Suite as Suite
from .suite.suite import load_suite as load_suite

__version__: str
