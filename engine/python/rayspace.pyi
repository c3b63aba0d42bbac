"""Ray-space objects: build one from photos, open it, render views of it, score them."""

from enum import Enum
from os import PathLike
from typing import Callable, Optional, Sequence, Union

import numpy as np
import numpy.typing as npt

_Path = Union[str, PathLike[str]]
_Progress = Callable[[str, float], None]

class Error(RuntimeError):
    """Failure; the message names the file, the place and the remedy."""

def version() -> tuple[int, int, int]:
    """Version as (major, minor, patch)."""

def version_text() -> str:
    """Version as text."""

class ImageScore:
    """Similarity of two images, over pixels where either image's alpha is above 0."""

    @property
    def psnr_db(self) -> float: ...
    @property
    def ssim(self) -> float: ...

def read_image(path: _Path) -> npt.NDArray[np.uint8]:
    """Reads an image file as uint8 (height, width, 4): sRGB with straight alpha."""

def write_png(path: _Path, image: npt.NDArray[np.uint8]) -> None:
    """Writes uint8 (height, width, 4) as a PNG file."""

def write_depth_exr(path: _Path, depth: npt.NDArray[np.float32]) -> None:
    """Writes float32 (height, width) as channel Z of an OpenEXR file."""

def compare_images(a: npt.NDArray[np.uint8], b: npt.NDArray[np.uint8]) -> ImageScore:
    """PSNR and SSIM of two images."""

class Camera:
    """Pinhole camera with OpenGL axes; lengths are in the units of the object's capture set."""

    width: int
    height: int
    fl_x: float
    fl_y: float
    cx: float
    cy: float
    def __init__(
        self,
        world_from_camera: npt.ArrayLike,
        width: int,
        height: int,
        *,
        fov_x_rad: Optional[float] = None,
        fl_x: Optional[float] = None,
        fl_y: Optional[float] = None,
        cx: Optional[float] = None,
        cy: Optional[float] = None,
    ) -> None: ...
    @property
    def world_from_camera(self) -> npt.NDArray[np.float64]: ...

class CapturedCamera:
    """Camera of a photo of a capture set."""

    @property
    def file(self) -> str: ...
    @property
    def camera(self) -> Camera: ...

def look_at(
    eye: Sequence[float], target: Sequence[float], fov_x_rad: float, width: int, height: int
) -> Camera:
    """A camera with square pixels and the principal point in the middle."""

def read_cameras(set: _Path) -> list[CapturedCamera]:
    """The cameras of a capture set."""

class RingInfo:
    """Ring of photos: one turn at one elevation."""

    @property
    def elevation_deg(self) -> float: ...
    @property
    def photos(self) -> int: ...
    @property
    def planes(self) -> int: ...
    @property
    def has_depth(self) -> bool: ...

class Object:
    """Ray-space object."""

    @staticmethod
    def open(path: _Path, *, level: int = 3, memory_cap_bytes: int = 8589934592) -> Object: ...
    @property
    def has_all_photos(self) -> bool: ...
    @property
    def name(self) -> str: ...
    @property
    def width(self) -> int: ...
    @property
    def height(self) -> int: ...
    @property
    def photos(self) -> int: ...
    @property
    def rings(self) -> list[RingInfo]: ...
    @property
    def units_per_radius(self) -> float: ...
    @property
    def ground_height(self) -> Optional[float]: ...
    def captured_cameras(self) -> list[CapturedCamera]: ...
    def photo(self, index: int) -> npt.NDArray[np.uint8]: ...
    def orbit(
        self,
        count: int,
        *,
        width: Optional[int] = None,
        height: Optional[int] = None,
        fov_x_rad: Optional[float] = None,
    ) -> list[Camera]: ...
    def look_at(
        self,
        eye: Sequence[float],
        target: Sequence[float],
        *,
        width: Optional[int] = None,
        height: Optional[int] = None,
        fov_x_rad: Optional[float] = None,
    ) -> Camera: ...
    def write(self, path: _Path) -> None: ...
    def extract(self, folder: _Path) -> None: ...

class Filter(Enum):
    """Sampling of the photos of objects with depth."""

    AUTO = 0
    SHARP = 1
    BILINEAR = 2
    SMOOTH = 3

class RenderedView:
    """A rendered view."""

    @property
    def image(self) -> npt.NDArray[np.uint8]: ...
    @property
    def depth(self) -> Optional[npt.NDArray[np.float32]]: ...

class Renderer:
    """Renders views of one object."""

    @staticmethod
    def create(object: Object, *, executor: str = "core", decoded_budget_bytes: int = 268435456) -> Renderer: ...
    @property
    def object(self) -> Object: ...
    def render(self, camera: Camera, *, filter: Filter = Filter.AUTO, depth: bool = False) -> RenderedView: ...

def executor_names() -> str:
    """Names of the executors."""

class MapKind(Enum):
    """RS map of an object."""

    SHAPE = 0
    PLANE = 1

class PhotoCoding(Enum):
    """Storage of the photos."""

    DENSE = 0
    BOARD = 1
    RAW = 2

class BuiltObject:
    """A built object."""

    @property
    def object(self) -> Object: ...
    @property
    def warnings(self) -> list[str]: ...
    @property
    def photos_psnr_db(self) -> Optional[float]: ...

def build_object(
    set: _Path,
    *,
    name: str = "",
    map: MapKind = MapKind.SHAPE,
    planes: int = 12,
    coding: PhotoCoding = PhotoCoding.DENSE,
    quality: float = 75.0,
    psnr_db: Optional[float] = None,
    photos_bytes: Optional[int] = None,
    effort: int = 5,
    alpha_bits: Optional[int] = None,
    progress: Optional[_Progress] = None,
) -> BuiltObject:
    """Builds an object from a capture set."""

class ViewScore:
    """Score of one view."""

    @property
    def photo(self) -> str: ...
    @property
    def score(self) -> ImageScore: ...

class Evaluation:
    """Scores of all views."""

    @property
    def views(self) -> list[ViewScore]: ...
    @property
    def mean_psnr_db(self) -> float: ...
    @property
    def pooled_psnr_db(self) -> float: ...
    @property
    def mean_ssim(self) -> float: ...

def compare_with_photos(renderer: Renderer, set: _Path, *, filter: Filter = Filter.AUTO) -> Evaluation:
    """Renders every pose of a capture set and compares it with the set's photo."""

def evaluate_held_out(
    set: _Path,
    *,
    every: int = 2,
    map: MapKind = MapKind.SHAPE,
    planes: int = 12,
    progress: Optional[_Progress] = None,
) -> Evaluation:
    """Builds an object from some photos of a set, renders the poses of the others, and compares."""
