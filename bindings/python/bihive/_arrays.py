"""The user's arrays as NumPy arrays, without a copy where possible."""

from __future__ import annotations

import math
from typing import Any, Optional

import numpy as np

from ._checks import whole_text
from ._errors import bad_argument, found, shortened

_CPU = 1  # kDLCPU of DLPack
_MOST = 2**37  # numbers, half a terabyte of float32: only an array that repeats one number has more


def as_array(name: str, value: Any) -> np.ndarray[Any, Any]:
    """Any array (buffer protocol, ``__array_interface__``, ``__array__``, DLPack on the CPU) or nested sequence."""
    array = value if type(value) is np.ndarray else _as_array(name, value)
    if array.size > _MOST:
        raise bad_argument(name, f"has shape {array.shape}, more than any memory holds")
    return array


def _as_array(name: str, value: Any) -> np.ndarray[Any, Any]:
    if isinstance(value, np.ma.MaskedArray):
        if np.ma.is_masked(value):  # type: ignore[no-untyped-call]
            raise bad_argument(name, "has masked entries, and every sphere or ray needs a number", "remove them first")
        return np.asarray(value.data)
    if isinstance(value, np.ndarray):
        return value
    only_dlpack = hasattr(value, "__dlpack__") and not hasattr(value, "__array_interface__")
    if only_dlpack:
        device = value.__dlpack_device__()[0] if hasattr(value, "__dlpack_device__") else _CPU
        if int(device) != _CPU:
            raise bad_argument(name, "is in the memory of a device", "copy it to the CPU first")
        try:
            return np.from_dlpack(value)
        except (RuntimeError, TypeError, ValueError, BufferError) as error:
            raise bad_argument(name, f"cannot be read by DLPack: {shortened(str(error))}") from None
    try:
        return np.asarray(value)
    except (TypeError, ValueError, RecursionError) as error:
        raise bad_argument(name, f"expected an array of numbers: {shortened(str(error))}") from None


def numbers(name: str, value: Any) -> np.ndarray[Any, Any]:
    """An array of float32 or float64 in this machine's byte order.

    Arrays of these two types are not copied, whatever their strides. Others of real numbers (integers, booleans, float16,
    long double, other byte orders, objects) are copied, to float64 or, of big-endian float32, to float32.
    """
    array = as_array(name, value)
    kind = array.dtype.kind
    if kind == "f" and array.dtype.itemsize in (4, 8):
        return array if array.dtype.isnative else array.astype(array.dtype.newbyteorder("="))
    if kind in "biuf" or (kind == "O" and array.size > 0):
        try:
            return array.astype(np.float64)
        except (TypeError, ValueError, OverflowError):
            pass
    if array.size == 0 and kind != "c":
        return array.astype(np.float64) if kind in "biufO" else np.zeros(array.shape)
    raise bad_argument(name, f"expected an array of real numbers, found dtype {array.dtype}")


def one_each(name: str, value: Any, count: int) -> np.ndarray[Any, Any]:
    """A number for each of ``count`` items, or one number for all of them (which takes no memory)."""
    array = numbers(name, value)
    if array.ndim == 0:
        return np.broadcast_to(array, (count,))
    if array.shape != (count,):
        raise bad_argument(name, f"expected one number, or shape ({count},), found shape {array.shape}")
    return array


def vectors(name: str, value: Any) -> np.ndarray[Any, Any]:
    """Shape (..., 3)."""
    array = numbers(name, value)
    if array.ndim == 0 or array.shape[-1] != 3:
        raise bad_argument(name, f"expected shape (..., 3), as (n, 3) or (3,), found shape {array.shape}")
    return array


def in_a_row(name: str, array: np.ndarray[Any, Any], shape: tuple[int, ...]) -> np.ndarray[Any, Any]:
    """Shape (n,): the entries of an array of this shape in C order, or n times one number (which takes no memory)."""
    if shape == () and array.size == 1 and array.ndim <= 1:
        return array.reshape(1)
    if array.ndim == 0:
        return np.broadcast_to(array, (math.prod(shape),))
    if array.shape != shape:
        raise bad_argument(name, f"expected one number, or shape {shape}, found shape {array.shape}")
    return array.reshape(-1)


def whole_numbers(name: str, value: Any, count: Optional[int], least: int, most: int) -> np.ndarray[Any, Any]:
    """An integer for each of ``count`` things (None: as they are), or one for all, from ``least`` to ``most``."""
    array = as_array(name, value)
    if array.size == 0 and array.dtype.kind == "f":
        array = array.astype(np.int64)
    if array.dtype.kind not in "iu":
        raise bad_argument(name, f"expected whole numbers, found dtype {array.dtype}")
    if array.size > 0 and (int(array.min()) < least or int(array.max()) > most):
        raise bad_argument(name, f"expected numbers from {least} to {most}, found {array.min()} to {array.max()}")
    if count is None:
        return array
    if array.ndim == 0:
        return np.broadcast_to(array, (count,))
    if array.shape != (count,):
        raise bad_argument(name, f"expected one number, or shape ({count},), found shape {array.shape}")
    return array


def texts(name: str, value: Any, count: int) -> list[str]:
    """A text for each of ``count`` items."""
    array = as_array(name, value)
    if array.shape != (count,):
        raise bad_argument(name, f"expected shape ({count},), found shape {array.shape}")
    made = array.tolist()
    for one in made:
        if not isinstance(one, (str, bytes)):
            raise bad_argument(name, f"expected texts or numbers, found {found(one)}")
    return [one.decode("utf-8", "replace") if isinstance(one, bytes) else whole_text(name, one) for one in made]
