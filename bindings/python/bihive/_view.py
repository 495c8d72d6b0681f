"""The page in a browser, with spheres in memory."""

from __future__ import annotations

import contextlib
import os
from typing import TYPE_CHECKING, Any, Iterator, Optional, Sequence, Union

from . import _bihive
from ._adapt import spheres_of
from ._camera import Look, Style
from ._checks import boolean, path_of
from ._errors import Error, InputError, MissingError, UsageError, bad_argument, found, shortened
from ._film import environment, program
from ._picture import Asked, Picture
from ._render import Camera, looks_of, picture_words
from ._spheres import Spheres, check_readable

if TYPE_CHECKING:
    import subprocess

    import numpy.typing as npt
    from typing_extensions import Unpack

    from ._option_types import RenderOptions

__all__ = ["Page", "View", "page", "save_page", "view"]


_LONGEST_NAME = 60  # characters: a folder takes names of 255 bytes
FRAME_PX = 520  # height of the page in a notebook
# The options of a picture that a page accepts. A page chooses its own number of samples.
_OF_PAGES = set(_bihive.options_of_pages()) - {"samples"}


class View:
    """A page that is served until close(), the end of a ``with``, or the end of Python."""

    def __init__(self, server: subprocess.Popen[str], url: str, folder: str, descriptors: list[int], words: list[str], name: str) -> None:
        self._server, self._folder, self._descriptors = server, folder, descriptors
        self._words, self._name = words, name
        self.url = url
        """The page's address on this machine."""

    @property
    def is_open(self) -> bool:
        """Whether the page is served."""
        return self._server.poll() is None

    def close(self) -> None:
        """Ends the server, and releases the memory of its spheres. Idempotent."""
        import atexit

        _end(self._server)
        _let_go(self._folder, self._descriptors)
        atexit.unregister(self.close)

    def __enter__(self) -> View:
        return self

    def __exit__(self, *_: Any) -> None:
        self.close()

    def __repr__(self) -> str:
        return f"<bihive.View: {self.url}{'' if self.is_open else ', closed'}>"

    def _repr_html_(self) -> str:
        if not self.is_open:
            return "closed"
        address = f'<a href="{self.url}" target="_blank">{self.url}</a>'
        # The address is one of the machine of the kernel, which the reader's browser may not reach.
        try:
            return Page(_text_of_page(self._words), self._name)._repr_html_() + address
        except Error:
            return address


class Page:
    """The page with spheres inside, made by page(): it shows itself in a notebook, also in one that was exported as HTML.

    There the page is in a frame of its own, which can neither reach the notebook nor a network.
    """

    def __init__(self, html: str, name: str, height: int = FRAME_PX) -> None:
        if not isinstance(html, str) or not isinstance(name, str):
            raise TypeError(f"a Page is made by page(), not of {found(html if not isinstance(html, str) else name)}")
        self.html = html
        """All of it, a document of HTML."""
        self.name = name
        """What the frame is called."""
        self.height = height
        """Of the frame, in pixels."""

    def _repr_html_(self) -> str:
        from html import escape

        return (
            f'<iframe title="{escape(self.name)}" sandbox="allow-scripts allow-downloads" allow="fullscreen" '
            f'style="width: 100vw; max-width: 100%; height: {self.height}px; border: 0" srcdoc="{escape(self.html)}"></iframe>'
        )

    def __repr__(self) -> str:
        return f"<bihive.Page: {self.name}, {len(self.html) / 1e6:.1f} MB>"


def _end(server: subprocess.Popen[str]) -> None:
    """Ends the program and closes the pipes to it."""
    if server.poll() is None:
        server.terminate()
        server.wait()
    for stream in (server.stdout, server.stderr):
        if stream is not None:
            stream.close()


def _let_go(folder: str, descriptors: list[int]) -> None:
    import shutil

    shutil.rmtree(folder, ignore_errors=True)
    # For several threads: each descriptor is closed by one of them.
    while True:
        try:
            descriptor = descriptors.pop()
        except IndexError:
            return
        os.close(descriptor)


# Spheres are in memory without a name in any folder; the link to it gives the page a name to show.
def _command_of(spheres: Spheres, folder: str, descriptors: list[int]) -> list[str]:
    content, _ = spheres._core.written("extxyz")
    descriptor = os.memfd_create("spheres")
    descriptors.append(descriptor)
    with open(os.dup(descriptor), "wb") as file:
        file.write(content)
    stem = os.path.splitext(os.path.basename(spheres.name))[0][:_LONGEST_NAME] or "spheres"
    link = os.path.join(folder, f"{stem}.extxyz")
    os.symlink(f"/proc/{os.getpid()}/fd/{descriptor}", link)
    return [link]


def _input_of(source: Any, folder: str, descriptors: list[int]) -> tuple[list[str], Optional[int]]:
    """The input of `bihive web`, and the number of spheres that lie in memory."""
    if isinstance(source, (str, os.PathLike)):
        return [check_readable(source, "source")], None
    spheres = spheres_of(source, "source")
    return _command_of(spheres, folder, descriptors), len(spheres)


def _failure(code: int, said: str, command: str) -> Exception:
    errors = [one for one in said.splitlines() if one.startswith("bihive: error: ")]
    text = errors[-1].removeprefix("bihive: error: ") if errors else f"{command} ended with {code}"
    text = shortened(text)
    return {1: InputError, 3: MissingError}.get(code, UsageError)(text)


def save_page(
    source: Any,
    path: Union[str, os.PathLike[str]],
    *,
    camera: Camera = None,
    style: Any = None,
    select: Union[str, npt.ArrayLike, None] = None,
    looks: Union[Look, Sequence[Look], None] = None,
    **options: Unpack[RenderOptions],
) -> None:
    """Writes the page with these spheres into one HTML file of some 2 MB plus data, which opens without a network or a server.

    source: as of view(). path: whole or not at all. Other arguments: those of render() that `bihive web` takes; camera and style
        are names, an Orthographic or a Perspective.

    Raises MissingError where the program ``bihive`` or its page (``make web``) is missing.
    """
    out = path_of("path", path)
    with _page_input(source) as (words, count):
        _run_web(["--html", out, *_words_of_page(camera, style, select, looks, dict(options), count), "--", *words])


def page(
    source: Any,
    *,
    camera: Camera = None,
    style: Any = None,
    select: Union[str, npt.ArrayLike, None] = None,
    looks: Union[Look, Sequence[Look], None] = None,
    **options: Unpack[RenderOptions],
) -> Page:
    """The page with these spheres inside, as save_page() writes it, for a notebook: as the last line of a cell they turn there.

    All arguments: as of save_page(). Nothing is served, so it works in a notebook on another machine, without a network, and after
    an export as HTML; each one makes the notebook some 2 MB larger.
    """
    with _page_input(source) as (words, count):
        chosen = _words_of_page(camera, style, select, looks, dict(options), count)
        return Page(_text_of_page([*chosen, "--", *words]), _name_of(source))


def _name_of(source: Any) -> str:
    return os.path.basename(os.fspath(source)) if isinstance(source, (str, os.PathLike)) else str(getattr(source, "name", "spheres"))


@contextlib.contextmanager
def _page_input(source: Any) -> Iterator[tuple[list[str], Optional[int]]]:
    """As _input_of(), as long as it is needed."""
    import tempfile

    folder = tempfile.mkdtemp(prefix="bihive_view_")
    descriptors: list[int] = []
    try:
        yield _input_of(source, folder, descriptors)
    finally:
        _let_go(folder, descriptors)


def _words_of_page(camera: Any, style: Any, select: Any, looks: Any, of_picture: dict[str, Any], count: Optional[int]) -> list[str]:
    if isinstance(camera, Picture) or isinstance(style, (dict, Style)):
        raise bad_argument("camera" if isinstance(camera, Picture) else "style", "of a page is a name")
    return picture_words(select, camera, style, looks_of(looks, of_picture), of_picture, count)


def _run_web(words: list[str]) -> None:
    import subprocess

    done = subprocess.run(
        [program(), "web", *words], env=environment(), stdin=subprocess.DEVNULL, capture_output=True, text=True, errors="replace"
    )
    if done.returncode != 0:
        raise _failure(done.returncode, done.stderr, "bihive web")


def _text_of_page(words: list[str]) -> str:
    """The page as one file that `bihive web` writes for these arguments."""
    import tempfile

    with tempfile.TemporaryDirectory(prefix="bihive_page_") as folder:
        out = os.path.join(folder, "page.html")
        _run_web(["--html", out, *words])
        with open(out, encoding="utf-8") as file:
            return file.read()


def page_of_picture(asked: Asked) -> str:
    """The page of what a picture was drawn of; what pictures alone have is left out."""
    source, camera, style, select, looks, options = asked
    return page(source, camera=camera, style=style, select=select, looks=looks, **{k: v for k, v in options.items() if k in _OF_PAGES}).html


def view(source: Any, *, port: Optional[int] = None, browser: Optional[bool] = None) -> View:
    """Opens the page with these spheres: they turn, are coloured, selected and saved there. No file is written.

    source: Spheres, atoms of ASE, an AtomGroup or Universe of MDAnalysis, the path of a file, or a built-in name. Spheres keep
        their colours, cell and attributes.
    port: of 127.0.0.1; left out: a free one. browser: whether one is opened; left out: not from within a notebook.

    In a notebook the answer shows the page in the cell, as page() does, and its address.

    The computation is the browser's own; nothing leaves this machine. Raises MissingError where the program ``bihive`` or its
    page (``make web``) is missing.
    """
    import atexit
    import json
    import subprocess
    import sys
    import tempfile

    if port is not None and (isinstance(port, bool) or not isinstance(port, int) or not 0 <= port <= 65535):
        raise bad_argument("port", f"expected a number from 0 to 65535, found {found(port)}")
    browser = "ipykernel" not in sys.modules if browser is None else boolean("browser", browser)
    folder = tempfile.mkdtemp(prefix="bihive_view_")
    descriptors: list[int] = []
    server: Optional[subprocess.Popen[str]] = None
    try:
        words, _ = _input_of(source, folder, descriptors)
        command = [program(), "web", "--json", "--port", str(port or 0), *([] if browser else ["--no-browser"]), "--", *words]
        server = subprocess.Popen(command, env=environment(), stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        assert server.stdout is not None and server.stderr is not None
        line = server.stdout.readline()
        if not line:
            raise _failure(server.wait(), server.stderr.read(), "bihive web")
        made = View(server, json.loads(line)["url"], folder, descriptors, ["--", *words], _name_of(source))
    except BaseException:
        if server is not None:
            _end(server)
        _let_go(folder, descriptors)
        raise
    atexit.register(made.close)
    return made
