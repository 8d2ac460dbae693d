from .api import make_scene as make_scene
from .api import make_shapes as make_shapes
from .arrays import DepthImage as DepthImage
from .arrays import Image as Image
from .arrays import LabelImage as LabelImage
from .camera.camera import Pose as Pose
from .camera.camera import RenderCamera as RenderCamera
from .errors import MissingBackendError as MissingBackendError
from .errors import RenderError as RenderError
from .errors import ReplayError as ReplayError
from .errors import SpecError as SpecError
from .handle.scene import Scene as Scene
from .handle.shapes import DrawnShapes as DrawnShapes
from .handle.view import View as View
from .rocks.family import Family as Family
from .rocks.family import register_family as register_family
from .rocks.record import RockModel as RockModel
from .sensor.sensor import Capture as Capture
from .sensor.sensor import Sensor as Sensor
from .sensor.sensor import SensorInput as SensorInput
from .sensor.sensor import register_sensor as register_sensor
from .spec import SceneSpec as SceneSpec
from .spec import load_spec as load_spec

__version__: str
