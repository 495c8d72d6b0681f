"""The exceptions of the package. Each states the fault, the argument and the remedy."""

from __future__ import annotations

import errno
import reprlib
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

__all__ = ["Error", "InputError", "UsageError", "FileError", "MissingError", "InputWarning", "failure"]


def safe(text: str) -> str:
    """The text as repr() writes it: control characters, invisible characters and bytes that are not UTF-8 are escaped."""
    return "".join(c if c.isprintable() or c == "\n" else c.encode("unicode_escape").decode() for c in text)


class Error(Exception):
    """The base of all of them.

    Attributes: ``argument`` (the argument's name, or ""), ``file``, ``line`` and ``column`` (from 1, 0: unknown), ``hint``.
    """

    def __init__(
        self, message: str, *, argument: str = "", file: str = "", line: int = 0, column: int = 0, hint: str = ""
    ) -> None:
        super().__init__(safe(message))
        self.argument = argument
        self.file = file
        self.line = line
        self.column = column
        self.hint = hint


class InputError(Error, ValueError):
    """Content that cannot be used: a file's, or numbers of an array."""


class UsageError(Error, ValueError):
    """An argument that is unknown, out of range, or contradicts another one."""


class FileError(Error, OSError):
    """A file that cannot be opened or written; ``errno`` and ``filename`` are those of OSError.

    It is also the subclass of OSError that its errno has: ``except FileNotFoundError`` catches that of a missing file.

    >>> isinstance(FileError(2, "No such file or directory", "a.pdb"), FileNotFoundError)
    True
    """

    def __new__(cls, number: int, text: str, path: str, *, argument: str = "path") -> FileError:
        kind = _FILE_ERRORS.get(number, cls) if cls is FileError else cls
        return OSError.__new__(kind, number, text, path)  # type: ignore[call-arg]

    def __init__(self, number: int, text: str, path: str, *, argument: str = "path") -> None:
        OSError.__init__(self, number, safe(text), path)
        self.argument = argument
        self.file = path
        self.line = self.column = 0
        self.hint = ""

    def __reduce__(self) -> Any:
        return FileError, (self.errno, self.strerror, self.filename), self.__dict__


class _NotFound(FileError, FileNotFoundError):
    pass


class _Exists(FileError, FileExistsError):
    pass


class _IsFolder(FileError, IsADirectoryError):
    pass


class _NoFolder(FileError, NotADirectoryError):
    pass


class _NoPermission(FileError, PermissionError):
    pass


_FILE_ERRORS: dict[int, type[FileError]] = {
    errno.ENOENT: _NotFound,
    errno.EEXIST: _Exists,
    errno.EISDIR: _IsFolder,
    errno.ENOTDIR: _NoFolder,
    errno.EACCES: _NoPermission,
    errno.EPERM: _NoPermission,
}
for _kind in _FILE_ERRORS.values():  # in messages they have the name that users know
    _kind.__name__ = _kind.__qualname__ = FileError.__name__


class MissingError(Error, RuntimeError):
    """Something that this machine lacks: a program, a driver, a device."""


class InputWarning(UserWarning):
    """Warnings of readers and pictures."""


def failure(
    kind: str, message: str, file: str, line: int, column: int, hint: str, shown: str, argument: str, system_code: int = 0
) -> Error:
    """The exception of a failure in the compiled part, which calls this. `system_code`: the errno, or 0."""
    message, hint = shortened(message, _LONGEST_MESSAGE), shortened(hint, _LONGEST_MESSAGE)
    hint = "" if hint.endswith("--help") else hint
    if system_code != 0 and kind == "input":
        path = file if len(file) <= _LONGEST_PATH else shortened(file)
        return FileError(system_code, message + ("; " + hint if hint else ""), path, argument=argument)
    place = ":".join([shortened(file), *(str(number) for number in (line, column) if number > 0)]) if file else ""
    text = (place + ": " if place else "") + message + ("; " + hint if hint else "")
    if 0 < len(shown) <= _LONGEST_MESSAGE:
        text += "\n" + "\n".join(printable(line) for line in shown.rstrip("\n").split("\n"))
    made: dict[str, type[Error]] = {"usage": UsageError, "missing": MissingError}
    return made.get(kind, InputError)(
        text,
        argument=argument,
        file=file,
        line=line,
        column=column,
        hint=hint,
    )


@contextmanager
def writing(path: str) -> Iterator[None]:
    """Makes a FileError of every failure to write this file: those that no system call reports too."""
    try:
        yield
    except InputError as error:
        raise FileError(errno.EIO, str(error), path) from None
    except FileError as error:
        error.argument = "path"
        raise


def bad_argument(argument: str, message: str, hint: str = "") -> UsageError:
    """An exception about an argument: "argument: message; hint"."""
    return UsageError(f"{argument}: {message}" + (f"; {hint}" if hint else ""), argument=argument, hint=hint)


_LONGEST = 160  # for text in a message that comes from a file or an argument
_LONGEST_PATH = 4096  # of Linux
_LONGEST_MESSAGE = 300
_REPR = reprlib.Repr()
_REPR.maxstring = _REPR.maxother = 60


def printable(text: str) -> str:
    """Escapes characters that do not belong in a line: controls, marks of direction, surrogates."""
    return text if text.isprintable() else "".join(one if one.isprintable() else ascii(one)[1:-1] for one in text)


def shortened(text: str, longest: int = _LONGEST) -> str:
    text = printable(text[: longest + 1])
    return text if len(text) <= longest else text[: longest - 3] + "..."


def found(value: Any) -> str:
    """A value in a message, shortened, in one line."""
    try:
        text = " ".join(_REPR.repr(value).split())
    except Exception:
        return f"an object of type {type(value).__name__}"
    text = printable(text)
    return text if len(text) <= 60 else text[:57] + "..."
