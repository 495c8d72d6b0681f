# The compiled module. The package around it checks the arguments.

from typing import Any, Callable, Optional, Sequence, Union

import numpy as np

_Array = np.ndarray[Any, Any]

__version__: str

def colour_maps() -> list[str]: ...
def colour_map_of_file(path: str) -> list[str]: ...
def options() -> list[tuple[str, str]]: ...
def actions() -> list[str]: ...

class Spheres:
    xyz: _Array
    radius: _Array
    element: Optional[_Array]
    type: Optional[_Array]
    colour: Optional[_Array]
    opacity: Optional[_Array]
    columns: dict[str, Union[_Array, list[str]]]
    cell: Optional[_Array]
    periodic: list[bool]
    bounds: _Array
    has_images: bool
    nbytes: int
    name: str
    format: str
    frames: int
    time_ps: Optional[float]
    step: Optional[int]
    rules: list[str]
    warnings: list[str]
    def __len__(self) -> int: ...
    def select(self, expression: str, name: str, periodic: bool) -> _Array: ...
    def what_there_is(self, expression: str) -> str: ...
    def statistics(self, words: list[str]) -> str: ...
    def written(self, format: str) -> tuple[bytes, list[str]]: ...

class Picture:
    pixels: _Array
    report: str
    methods: str
    warnings: list[str]
    has_scene: bool
    hash: int
    def layer(self, name: str) -> _Array: ...
    def png(self) -> bytes: ...
    def save(self, path: bytes, metadata: bool) -> None: ...
    def save_tiff(self, path: bytes, metadata: bool) -> None: ...
    def save_exr(self, path: bytes, names: str, metadata: bool) -> None: ...
    def detach(self) -> None: ...

class Tree:
    build_ms: float
    periodic: bool
    def __len__(self) -> int: ...
    def closest(
        self,
        origin: _Array,
        direction: _Array,
        t_min: Optional[_Array],
        t_max: Optional[_Array],
        leaves: Optional[_Array],
        inside: Optional[_Array],
        see_images: bool,
        in_blocks: bool,
    ) -> tuple[_Array, _Array]: ...
    def occluded(
        self,
        origin: _Array,
        direction: _Array,
        t_min: Optional[_Array],
        t_max: Optional[_Array],
        leaves: Optional[_Array],
        inside: Optional[_Array],
        see_images: bool,
        in_blocks: bool,
    ) -> _Array: ...
    def all_hits(
        self,
        origin: _Array,
        direction: _Array,
        t_min: Optional[_Array],
        t_max: Optional[_Array],
        leaves: Optional[_Array],
        inside: Optional[_Array],
        see_images: bool,
    ) -> tuple[_Array, _Array, _Array]: ...
    def nearest(self, points: _Array, k: int, within: float, to_centre: bool) -> tuple[_Array, _Array]: ...
    def within(self, points: _Array, limits: _Array, to_centre: bool) -> tuple[_Array, _Array, _Array]: ...

class FilmFile:
    def __init__(self, output: str) -> None: ...
    def descriptor(self) -> int: ...
    def has(self, name: str) -> bool: ...
    def place(self, name: str) -> None: ...
    def leave(self) -> None: ...

def spheres_from_arrays(
    xyz: _Array,
    radius: _Array,
    element: Optional[_Array],
    type: Optional[_Array],
    colour: Optional[_Array],
    opacity: Optional[_Array],
    numbers: list[tuple[str, Any]],
    texts: list[tuple[str, list[str]]],
    cell: Optional[_Array],
    periodic: tuple[bool, bool, bool],
    format: str,
    name: str,
) -> Spheres: ...
def read(words: Sequence[Union[str, bytes]]) -> Spheres: ...
def reading_settings() -> list[str]: ...
def write_file(path: bytes, content: bytes) -> None: ...
def render(
    spheres: Optional[Spheres],
    words: Sequence[Union[str, bytes]],
    style_text: str,
    like: Optional[Picture],
    progress: Optional[Callable[[float], None]],
) -> Picture: ...
def again(
    figure: bytes, input: bytes, words: Sequence[Union[str, bytes]], progress: Optional[Callable[[float], None]]
) -> Picture: ...
def verify(
    figure: bytes, input: bytes, difference: bytes, progress: Optional[Callable[[float], None]]
) -> tuple[str, str]: ...
def build_tree(spheres: Spheres, part: Optional[list[int]], periodic: bool, words: list[str]) -> Tree: ...
def colours_of(values: Union[_Array, list[str]], how: str, nan_colour: str) -> _Array: ...
def linear_colour(text: str) -> Optional[tuple[float, float, float]]: ...
def check_selection(text: str) -> None: ...
def check_environment() -> None: ...
def atomic_number(symbol: str) -> int: ...
def element_symbol(number: int) -> str: ...
def van_der_waals_radius(number: int) -> float: ...
def target() -> str: ...
