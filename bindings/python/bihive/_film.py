"""Films: of a file by the program `bihive film`, of frames in memory by pictures that go into ffmpeg."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Any, Iterable, Iterator, Optional, Sequence, Union

import numpy as np

from ._adapt import is_atom_group, is_universe, spheres_of
from ._camera import Style
from ._checks import path_of, several
from ._errors import FileError, MissingError, UsageError, bad_argument, found, shortened
from ._options import option, words_of
from ._picture import Picture
from ._progress import Bar
from ._render import Camera, Progress, draw, picture_words, style_text
from ._spheres import Spheres, check_readable

# Films alone need these, and they would take half of the time of an import of this package.
if TYPE_CHECKING:
    from fractions import Fraction

__all__ = ["film"]

_ENDINGS = [".mp4", ".mov", ".mkv", ".webm"]
# What `bihive film` alone can do.
_OF_PROGRAM = ["frames", "pictures", "turntable", "camera_keys", "colour_range", "codec", "shard", "join"]


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


def _film_of_file(source: str, path: str, words: list[str], progress: Progress) -> None:
    import subprocess

    from ._errors import in_python

    command = [program(), "film", "-o", path, *words, "--", source]
    # The program shows its own progress, on a terminal.
    done = subprocess.run(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True, errors="replace")
    lines = done.stderr.splitlines()
    if done.returncode == 0:
        return
    errors = [line for line in lines if line.startswith("bihive: error: ")]
    text = in_python(errors[-1].removeprefix("bihive: error: ") if errors else done.stderr.strip())
    if done.returncode in (130, -2):
        raise KeyboardInterrupt
    raise {2: UsageError, 3: MissingError}.get(done.returncode, UsageError)(text)


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
    """ffmpeg that encodes pictures into a file beside the film, which gets its name when it is whole."""

    def __init__(self, path: str, size: tuple[int, int], rate: Fraction) -> None:
        import shutil
        import subprocess
        import tempfile

        program = shutil.which("ffmpeg")
        if program is None:
            raise MissingError("films are encoded by the program ffmpeg, which is not in PATH", hint="install ffmpeg")
        ending = os.path.splitext(path)[1].lower()
        folder = os.path.dirname(os.path.abspath(path))
        try:
            handle, self._aside = tempfile.mkstemp(prefix=".bihive-", suffix=".part" + ending, dir=folder)
        except OSError as error:
            raise FileError(error.errno or 0, error.strerror or str(error), path) from None
        os.close(handle)
        self._path = path
        codec = ["-c:v", "libx264", "-crf", "18"]
        if ending == ".webm":
            codec = ["-c:v", "libvpx-vp9", "-crf", "24", "-b:v", "0", "-row-mt", "1"]
        colours = ["-pix_fmt", "yuv420p", "-colorspace", "bt709", "-color_primaries", "bt709", "-color_trc", "bt709"]
        command = [program, "-hide_banner", "-nostdin", "-loglevel", "error", "-y", "-f", "rawvideo"]
        command += ["-pixel_format", "rgb24", "-video_size", f"{size[0]}x{size[1]}"]
        command += ["-framerate", f"{rate.numerator}/{rate.denominator}", "-i", "pipe:0", "-an"]
        command += ["-vf", "pad=ceil(iw/2)*2:ceil(ih/2)*2,scale=out_color_matrix=bt709:out_range=tv", *codec]
        command += [*colours, "-color_range", "tv", "file:" + self._aside]
        self._log = tempfile.TemporaryFile()
        # A group of its own: Ctrl-C is for Python, which ends it.
        self._run = subprocess.Popen(command, stdin=subprocess.PIPE, stderr=self._log, start_new_session=True)

    def add(self, picture: Picture) -> None:
        assert self._run.stdin is not None
        try:
            self._run.stdin.write(np.ascontiguousarray(np.asarray(picture)[:, :, :3]).data)
        except BrokenPipeError:
            self._fail()

    def finish(self) -> None:
        assert self._run.stdin is not None
        try:
            self._run.stdin.close()
        except BrokenPipeError:
            pass
        if self._run.wait() != 0:
            self._fail()
        umask = os.umask(0)
        os.umask(umask)
        os.chmod(self._aside, 0o666 & ~umask)
        try:
            os.replace(self._aside, self._path)
        except OSError as error:
            raise FileError(error.errno or 0, error.strerror or str(error), self._path) from None
        self._aside = ""

    def _fail(self) -> None:
        self._run.wait()
        self._log.seek(0)
        said = self._log.read().decode("utf-8", "replace").strip().splitlines()
        raise MissingError("ffmpeg failed" + (f", and said: {said[-1]}" if said else ""))

    def leave(self) -> None:
        """Nothing half-written stays."""
        if self._run.poll() is None:
            self._run.kill()
        if self._run.stdin is not None:
            try:
                self._run.stdin.close()
            except BrokenPipeError:
                pass
        self._run.wait()
        self._log.close()
        if self._aside and os.path.exists(self._aside):
            os.unlink(self._aside)


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
    select: Optional[str] = None,
    looks: Any = None,
    progress: Progress = None,
    **options: Any,
) -> int:
    """Makes a film, and returns the number of its pictures (0: not known, of a file).

    source: the path of a file with frames, or of any file with turntable=360: what `bihive film` makes, with all its options
        (turntable, pictures, camera_keys, colour_range, codec) and frames="A:B:STEP". Or frames in memory: a Universe or
        AtomGroup of MDAnalysis (whose trajectory runs), a trajectory with atoms=universe.atoms, or any iterable of Spheres or
        atoms, such as a list of ASE's. Camera and ranges of colours are those of the first frame.
    path: .mp4, .mov, .mkv or .webm, whole or not at all; ffmpeg must be there.
    frames: of frames in memory a slice or positions.
    Other arguments as those of render().
    """
    out = path_of("path", path)
    ending = os.path.splitext(out)[1].lower()
    if isinstance(source, (str, os.PathLike)):
        if isinstance(camera, Picture) or isinstance(style, (dict, Style)):
            raise bad_argument("camera" if isinstance(camera, Picture) else "style", "of a film of a file is a name")
        of_film = {name: options.pop(name) for name in _OF_PROGRAM if name in options}
        if frames is not None:
            of_film["frames"] = frames
        words = [option(name, value) for name, value in {"fps": fps, **of_film}.items() if value is not None]
        words += picture_words(select, camera, style, looks, {"size": size, **options})
        _film_of_file(check_readable(source, "source"), out, words, progress)
        return 0
    if ending not in _ENDINGS:
        raise bad_argument("path", f"expected .mp4, .mov, .mkv or .webm, found {found(out)}")
    if isinstance(frames, str):
        raise bad_argument("frames", "of frames in memory is a slice or positions", "frames=slice(0, 100, 10)")
    if options.get("bits") is not None and words_of({"bits": options["bits"]}) != ["--bits=8"]:
        raise bad_argument("bits", "a film has 8 bits")
    if isinstance(options.get("background"), str) and options["background"] == "none":
        raise bad_argument("background", "a film has no transparency")
    rate = _rate(fps)
    words = picture_words(select, camera, style, looks, {"size": size, **options})
    like = camera if isinstance(camera, Picture) else None
    encoder: Optional[_Ffmpeg] = None
    count = 0
    try:
        with Bar(progress if isinstance(progress, bool) else None, "filming"):
            for spheres in _frames_of(source, atoms, frames):
                all_words = ["-o", "picture.png", *words, f"--frame={count}", "--", "spheres"]
                # The first frame is drawn once more, with the camera and the ranges that it gives to all.
                like = like or draw(spheres, all_words, style_text(style), None, False)
                picture = draw(spheres, all_words, style_text(style), like, False)
                if encoder is None:
                    encoder = _Ffmpeg(out, picture.size, rate)
                encoder.add(picture)
                count += 1
                if callable(progress):
                    progress(float(count))
        if encoder is None:
            raise bad_argument("source", "holds no frames")
        encoder.finish()
    finally:
        if encoder is not None:
            encoder.leave()
    return count
