"""Films: of a file by the program `bihive film`, of frames in memory by pictures that go into ffmpeg."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Any, Iterable, Iterator, Optional, Sequence, Union

import numpy as np

from . import _bihive
from ._adapt import is_atom_group, is_universe, spheres_of
from ._array_columns import arrays_as_columns
from ._camera import Look, Style
from ._checks import boolean, path_of, several
from ._errors import MissingError, UsageError, bad_argument, found, shortened, writing
from ._links import LinkTable
from ._options import option, words_of
from ._picture import Picture
from ._progress import Bar, Progress
from ._render import Camera, draw, looks_of, picture_words, style_text
from ._spheres import Spheres, check_readable

# Films alone need these, and they would take half of the time of an import of this package.
if TYPE_CHECKING:
    import numpy.typing as npt
    import subprocess
    from fractions import Fraction
    from typing_extensions import Unpack

    from ._option_types import FilmOptions

__all__ = ["film"]

# Time limit for an interrupted program to finish.
_PATIENCE_S = 15
# Interval at which a wait checks for signals.
_LOOK_S = 0.1
_ENDINGS = [".mp4", ".mov", ".mkv", ".webm"]
# What `bihive film` alone can do.
_OF_PROGRAM = ["frames", "pictures", "hold_first", "hold_last", "turntable", "turn_axis", "follow", "align", "fit_frames", "camera_keys", "colour_range", "codec", "shard"]
_FLAGS_OF_PROGRAM = ["reverse", "ping_pong"]


def environment(**more: str) -> dict[str, str]:
    """That of the program, whose messages then name settings as Python does: radius_scale."""
    return {**os.environ, "BIHIVE_SETTING_NAMES": "ids", **more}


def program() -> str:
    """The program `bihive`: as BIHIVE says, in the folder of the build or of the installation, or in PATH."""
    import shutil

    here = os.path.dirname(os.path.abspath(__file__))
    places = [os.environ.get("BIHIVE", ""), os.path.join(here, "bin", "bihive")]
    places += [os.path.join(here, *[".."] * up, tail) for up in (2, 4, 5) for tail in ("bihive", os.path.join("bin", "bihive"))]
    for place in places:
        if place and os.path.isfile(place) and os.access(place, os.X_OK):
            return place
    program = shutil.which("bihive")
    if program is None:
        raise MissingError(
            "a film of a file is made by the program bihive, which is not in PATH",
            hint="name it by BIHIVE in the environment, or give frames: film([read(path, frame=i) for i in ...], ...)",
        )
    return program


def _said(run: subprocess.Popen[Any]) -> tuple[Any, Any]:
    """What a program prints until its end. A signal between two steps of Python does not wake an endless wait."""
    import subprocess

    while True:
        try:
            return run.communicate(timeout=_LOOK_S)
        except subprocess.TimeoutExpired:
            continue


# The program's line of progress: the finished share of the film itself. Earlier steps have other names.
_SHARE = "bihive: progress: film "


def _read_lines(stream: Any, lines: list[str], shares: list[float]) -> None:
    """Until the end of the stream: shares of the film, and all other lines."""
    for line in stream:
        if line.startswith(_SHARE):
            shares[0] = float(line.removeprefix(_SHARE))
        elif not line.startswith("bihive: progress: "):
            lines.append(line)


def _film_of_file(source: str, path: str, words: list[str], progress: Progress) -> None:
    import subprocess
    import threading

    command = [program(), "film", "-o", path, *words, "--", source]
    lines: list[str] = []
    shares = [0.0]
    with Bar(progress, "filming") as bar, subprocess.Popen(
        command,
        env=environment(BIHIVE_PROGRESS="shares"),
        stdout=subprocess.DEVNULL,
        stderr=subprocess.PIPE,
        text=True,
        errors="replace",
    ) as run:
        reader = threading.Thread(target=_read_lines, args=(run.stderr, lines, shares), daemon=True)
        try:
            reader.start()
            # A signal between two steps of Python does not wake an endless wait.
            while reader.is_alive():
                reader.join(_LOOK_S)
                if bar is not None and reader.is_alive():
                    bar(shares[0])
            run.wait()
            if bar is not None and run.returncode == 0:
                bar(1.0)
        except BaseException:
            # The program finishes its current work, then ends. On a terminal Ctrl-C has reached it too.
            run.terminate()
            try:
                run.wait(_PATIENCE_S)
            except subprocess.TimeoutExpired:
                run.kill()
            raise
        finally:
            reader.join(_PATIENCE_S)
    said = "".join(lines)
    if run.returncode == 0:
        return
    errors = [line for line in said.splitlines() if line.startswith("bihive: error: ")]
    text = errors[-1].removeprefix("bihive: error: ") if errors else said.strip()
    if run.returncode in (130, -2):
        raise KeyboardInterrupt
    raise {2: UsageError, 3: MissingError}.get(run.returncode, UsageError)(text)


def _chosen(source: Any, frames: Union[slice, Sequence[int]]) -> Any:
    try:
        if isinstance(frames, slice):
            return source[frames]
        return [source[i] for i in several("frames", frames, "a slice or positions")]
    except (TypeError, IndexError, KeyError) as error:
        raise bad_argument("frames", f"cannot be taken from source: {shortened(str(error))}") from None


def _frames_of(source: Any, atoms: Any, frames: Union[slice, Sequence[int], None]) -> Iterator[Spheres]:
    """The spheres of each frame in turn. Those of MDAnalysis move with their trajectory."""
    if is_universe(source):
        source, atoms = source.trajectory, source.atoms
    elif is_atom_group(source):
        source, atoms = source.universe.trajectory, source
    if atoms is not None:
        steps: Iterable[Any] = source if frames is None else _chosen(source, frames)
        for _ in steps:
            yield spheres_of(atoms, "atoms")
        return
    if frames is not None:
        source = _chosen(source, frames)
    try:
        steps = iter(source)
    except TypeError:
        raise bad_argument("source", f"expected a path, frames, a Universe or atoms, found {found(source)}") from None
    for step in steps:
        if hasattr(step, "triclinic_dimensions"):
            raise bad_argument(
                "source", "a trajectory of MDAnalysis does not know its atoms", "give the universe, or atoms=universe.atoms"
            )
        yield spheres_of(step, "source")


def _count_of(source: Any, frames: Union[slice, Sequence[int], None]) -> int:
    """The number of frames, or 0 if it is not known before the last."""
    import operator

    if is_universe(source):
        source = source.trajectory
    elif is_atom_group(source):
        source = source.universe.trajectory
    try:
        if frames is None:
            return operator.length_hint(source, 0)
        return len(range(*frames.indices(len(source)))) if isinstance(frames, slice) else len(frames)
    except (TypeError, ValueError, AttributeError):
        return 0


def _rate(fps: Any) -> Fraction:
    from fractions import Fraction

    try:
        rate = Fraction(fps).limit_denominator(1001) if isinstance(fps, float) else Fraction(fps)
    except (TypeError, ValueError, ArithmeticError):
        rate = Fraction(0)
    if rate <= 0:
        raise bad_argument("fps", f"expected a number above 0, or a fraction, found {found(fps)}")
    return rate


class _Ffmpeg:
    """Runs ffmpeg to encode pictures into a file in a hidden folder beside the film, which replaces the film in the end.

    The folder and the replacement are those of `bihive film`.
    """

    def __init__(self, path: str, size: tuple[int, int], rate: Fraction) -> None:
        import shutil
        import subprocess
        import tempfile

        program = shutil.which("ffmpeg")
        if program is None:
            raise MissingError("films are encoded by the program ffmpeg, which is not in PATH", hint="install ffmpeg")
        self._program = program
        ending = os.path.splitext(path)[1].lower()
        with writing(path):
            self._file = _bihive.FilmFile(os.fsencode(path))
        self._path = path
        self._name = "film" + ending
        self._count = 0
        codec = ["-c:v", "libx264", "-crf", "18"]
        if ending == ".webm":
            codec = ["-c:v", "libvpx-vp9", "-crf", "24", "-b:v", "0", "-row-mt", "1"]
        colours = ["-pix_fmt", "yuv420p", "-colorspace", "bt709", "-color_primaries", "bt709", "-color_trc", "bt709"]
        command = ["-f", "rawvideo", "-pixel_format", "rgb24", "-video_size", f"{size[0]}x{size[1]}"]
        command += ["-framerate", f"{rate.numerator}/{rate.denominator}", "-i", "pipe:0", "-an"]
        command += ["-vf", "pad=ceil(iw/2)*2:ceil(ih/2)*2,scale=out_color_matrix=bt709:out_range=tv", *codec]
        command += [*colours, "-color_range", "tv", self._url()]
        self._log = tempfile.TemporaryFile()
        try:
            self._run = self._start(command, subprocess.PIPE)
            assert self._run.stdin is not None
            os.set_blocking(self._run.stdin.fileno(), False)
        except BaseException:
            self._log.close()
            self._file.leave()
            raise

    def _url(self) -> str:
        """The file in the folder, whatever becomes of the folder's name."""
        return f"file:/proc/self/fd/{self._file.descriptor()}/{self._name}"

    def _start(self, words: list[str], stdin: Any) -> subprocess.Popen[bytes]:
        import subprocess

        command = [self._program, "-hide_banner", "-nostdin", "-loglevel", "error", "-y", *words]
        # A group of its own: Ctrl-C is for Python, which ends it.
        try:
            return subprocess.Popen(
                command,
                stdin=stdin,
                stdout=subprocess.PIPE if stdin == subprocess.DEVNULL else subprocess.DEVNULL,
                stderr=self._log,
                start_new_session=True,
                pass_fds=(self._file.descriptor(),),
            )
        except OSError as error:
            raise MissingError(f"ffmpeg cannot be started: {error.strerror}") from None

    def add(self, picture: Picture) -> None:
        import select

        assert self._run.stdin is not None
        pipe = self._run.stdin.fileno()
        left = np.ascontiguousarray(np.asarray(picture)[:, :, :3]).data.cast("B")
        while left:
            try:
                left = left[os.write(pipe, left) :]
            except BlockingIOError:
                select.select([], [pipe], [], _LOOK_S)
            except BrokenPipeError:
                self._fail()
        self._count += 1

    def finish(self) -> None:
        assert self._run.stdin is not None
        self._run.stdin.close()
        if self._end() != 0:
            self._fail()
        self._check()
        with writing(self._path):
            self._file.place(self._name)

    def _end(self) -> int:
        import subprocess

        while True:
            try:
                return self._run.wait(_LOOK_S)
            except subprocess.TimeoutExpired:
                continue

    def _check(self) -> None:
        """Whether ffmpeg has written all pictures: it counts them itself."""
        import subprocess

        hint = f"check that {self._program} is really ffmpeg"
        if not self._file.has(self._name):
            raise MissingError("ffmpeg reported success, but wrote no film", hint=hint)
        words = ["-progress", "pipe:1", "-i", self._url(), "-map", "0:v:0", "-c", "copy", "-f", "null", "-"]
        self._run = self._start(words, subprocess.DEVNULL)
        said = _said(self._run)[0].decode("utf-8", "replace")
        counts = [line.partition("=")[2].strip() for line in said.splitlines() if line.startswith("frame=")]
        if self._run.returncode != 0 or not counts or counts[-1] != str(self._count):
            wrote = counts[-1] + " pictures" if counts else "a file that is not a film"
            raise MissingError(f"ffmpeg was given {self._count} pictures, and wrote {wrote}", hint=hint)

    def _fail(self) -> None:
        self._end()
        self._log.seek(0)
        said = self._log.read().decode("utf-8", "replace").strip().splitlines()
        raise MissingError("ffmpeg failed" + (f", and said: {said[-1]}" if said else ""))

    def leave(self) -> None:
        """Leaves no partial file, and no process that ffmpeg has started: it may be a script."""
        import signal

        if self._run.poll() is None:
            os.killpg(self._run.pid, signal.SIGKILL)
        for pipe in (self._run.stdin, self._run.stdout):
            if pipe is not None:
                try:
                    pipe.close()
                except BrokenPipeError:
                    pass
        self._run.wait()
        self._log.close()
        self._file.leave()


def film(
    source: Any,
    path: Union[str, os.PathLike[str]],
    *,
    atoms: Any = None,
    frames: Union[slice, Sequence[int], str, None] = None,
    fps: Any = 25,
    camera: Camera = None,
    style: Any = None,
    size: Optional[tuple[int, int]] = None,
    select: Union[str, npt.ArrayLike, None] = None,
    looks: Union[Look, Sequence[Look], None] = None,
    progress: Progress = None,
    **options: Unpack[FilmOptions],
) -> int:
    """Makes a film, and returns the number of its pictures (0: not known, of a file).

    source: the path of a file with frames, or of any file with turntable=360: what `bihive film` makes, with all its options
        (hold_first, hold_last, reverse=True, ping_pong=True, turntable, turn_axis, follow, align, fit_frames, pictures, camera_keys,
        colour_range, codec) and
        frames="A:B:STEP". Or frames in memory: a Universe or
        AtomGroup of MDAnalysis (whose trajectory runs), a trajectory with atoms=universe.atoms, or any iterable of Spheres or
        atoms, such as a list of ASE's. Camera and ranges of colours are those of the first frame.
    path: .mp4, .mov, .mkv or .webm, whole or not at all; ffmpeg must be there.
    frames: of frames in memory a slice or positions.
    progress: as of render(); the share stays 0 until the end where the number of frames is not known before (a generator).
    Other arguments as those of render().
    """
    out = path_of("path", path)
    given_options: dict[str, Any] = dict(options)
    ending = os.path.splitext(out)[1].lower()
    if isinstance(source, (str, os.PathLike)):
        if isinstance(camera, Picture) or isinstance(style, (dict, Style)):
            raise bad_argument("camera" if isinstance(camera, Picture) else "style", "of a film of a file is a name")
        of_film = {name: given_options.pop(name) for name in _OF_PROGRAM if name in given_options}
        if frames is not None:
            of_film["frames"] = frames
        flags = {name: given_options.pop(name) for name in _FLAGS_OF_PROGRAM if name in given_options}
        words = [option(name, value) for name, value in {"fps": fps, **of_film}.items() if value is not None]
        words += ["--" + name.replace("_", "-") for name, value in flags.items() if value is not None and boolean(name, value)]
        of_picture: dict[str, Any] = {"size": size, **given_options}
        words += picture_words(select, camera, style, looks_of(looks, of_picture), of_picture)
        _film_of_file(check_readable(source, "source"), out, words, progress)
        return 0
    if ending not in _ENDINGS:
        raise bad_argument("path", f"expected .mp4, .mov, .mkv or .webm, found {found(out)}")
    if isinstance(frames, str):
        raise bad_argument("frames", "of frames in memory is a slice or positions", "frames=slice(0, 100, 10)")
    if given_options.get("bits") is not None and words_of({"bits": given_options["bits"]}) != ["--bits=8"]:
        raise bad_argument("bits", "a film has 8 bits")
    if isinstance(given_options.get("background"), str) and given_options["background"] == "none":
        raise bad_argument("background", "a film has no transparency")
    for name in [*_OF_PROGRAM, *_FLAGS_OF_PROGRAM]:
        if given_options.get(name) is not None:
            raise bad_argument(name, "is for a film of a file", "give the file's path, or the frames in the order of the film")
    rate = _rate(fps)
    like = camera if isinstance(camera, Picture) else None
    of_pictures: dict[str, Any] = {"size": size, **given_options}
    given = looks_of(looks, of_pictures)
    encoder: Optional[_Ffmpeg] = None
    count = 0
    try:
        in_all = _count_of(source, frames)
        with Bar(progress, "filming") as bar, LinkTable(of_pictures):
            for spheres in _frames_of(source, atoms, frames):
                of_frame = dict(of_pictures)
                spheres, named = arrays_as_columns(spheres, of_frame, given)
                words = picture_words(select, camera, style, named, of_frame, len(spheres))
                all_words = [*words, f"--frame={count}", "--", "spheres"]
                # The first frame is drawn again, with the camera and the ranges that it determines for all.
                like = like or draw(spheres, all_words, given, style_text(style), None, False)
                picture = draw(spheres, all_words, given, style_text(style), like, False)
                if encoder is None:
                    encoder = _Ffmpeg(out, picture.size, rate)
                encoder.add(picture)
                count += 1
                if bar is not None:
                    bar(min(count / in_all, 1.0) if in_all > 0 else 0.0)
            if encoder is None:
                raise bad_argument("source", "holds no frames")
            encoder.finish()
            if bar is not None:
                bar(1.0)
    finally:
        if encoder is not None:
            encoder.leave()
    return count
