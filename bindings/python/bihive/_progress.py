"""A progress bar for interactive sessions."""

from __future__ import annotations

import sys
import time
from typing import Any, Callable, Optional, Union

from ._errors import bad_argument, found

_PATIENCE_S = 1.0


def _somebody_looks() -> bool:
    if "ipykernel" in sys.modules:
        return True
    try:
        return sys.stderr is not None and sys.stderr.isatty()
    except (AttributeError, ValueError):
        return False


Progress = Union[None, bool, Callable[[float], object]]


class Bar:
    """Called with the finished share several times per second; shows a bar of tqdm once the work has taken a second."""

    def __init__(self, progress: Progress, what: str) -> None:
        if progress is not None and not isinstance(progress, bool) and not callable(progress):
            raise bad_argument("progress", f"expected None, True, False or a function, found {found(progress)}")
        self._call = progress if callable(progress) else None
        self._shown = progress if isinstance(progress, bool) else progress is None and _somebody_looks()
        self._what = what
        self._begun = time.monotonic()
        self._bar: Optional[Any] = None

    def __enter__(self) -> Optional[Callable[[float], None]]:
        return self._update if self._call is not None or self._shown else None

    def _update(self, done: float) -> None:
        if self._call is not None:
            self._call(done)
            return
        if self._bar is None:
            if time.monotonic() - self._begun < _PATIENCE_S:
                return
            try:
                from tqdm.auto import tqdm  # type: ignore[import]
            except ImportError:
                self._shown = False
                return
            self._bar = tqdm(total=100, desc=self._what, unit="%", leave=False)
        self._bar.update(round(100 * done) - self._bar.n)

    def __exit__(self, *_: object) -> None:
        if self._bar is not None:
            self._bar.close()
