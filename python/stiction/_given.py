# SPDX-License-Identifier: Apache-2.0
"""What is given to the package, checked: each error names what was found and what was expected."""
from __future__ import annotations

import importlib
import numbers
import operator
import os
from fractions import Fraction
from os import PathLike
from typing import Any, Union

import numpy as np
from numpy.typing import NDArray

Number = Union[Fraction, float]
Path = Union[str, "PathLike[str]"]
Vector = NDArray[np.float64]


def exact_text(value: Any, name: str) -> str:
    """An exact number as stiction reads it: of an int, Fraction, float or text."""
    if isinstance(value, (np.generic, np.ndarray)) and value.ndim == 0:
        value = value.item()
    try:
        return str(Fraction(*value.as_integer_ratio()) if isinstance(value, np.floating) else Fraction(value))
    except (TypeError, ValueError, OverflowError, ZeroDivisionError):
        raise ValueError(f"{name}: found {value!r}, expected a finite number or a fraction as text") from None


def is_one(value: Any) -> bool:
    """Whether it is no sequence of numbers or words, but one."""
    return isinstance(value, (str, numbers.Number, np.generic)) or (isinstance(value, np.ndarray) and value.ndim == 0)


def listed(value: Any, name: str) -> list[Any]:
    """One, or what a sequence has."""
    if is_one(value):
        return [value]
    try:
        return list(value)
    except TypeError:
        raise TypeError(f"{name}: found {value!r}, expected a sequence") from None


def unmasked(value: Any, name: str) -> Any:
    """The value itself. ValueError for an array of which something is masked."""
    if isinstance(value, np.ma.MaskedArray) and np.ma.getmaskarray(value).any():  # type: ignore[no-untyped-call]
        raise ValueError(f"{name}: found an array with masked entries, expected numbers everywhere")
    return value


def doubles(array: NDArray[Any]) -> Vector | None:
    """The array itself if it has doubles, or doubles that are the same numbers; None where there are none."""
    most = 2 ** 53  # up to which integers are doubles
    kind, bytes_each = array.dtype.kind, array.dtype.itemsize
    fits = (kind == "f" and bytes_each <= 8) or (
        kind in "iu" and (bytes_each <= 4 or array.size == 0 or (int(array.min()) >= -most and int(array.max()) <= most)))
    return array.astype(np.float64, copy=False) if fits else None


def shortened(text: str, most: int = 60) -> str:
    """For one line of many."""
    line = " ".join(text.split())
    return line if len(line) <= most else line[:most] + "..."


def require_text(**words: Any) -> None:
    for name, word in words.items():
        if not isinstance(word, str):
            raise TypeError(f"{name}: found {word!r}, expected text")


def integer(name: str, value: Any) -> int:
    try:
        return operator.index(value)
    except TypeError:
        raise TypeError(f"{name}: found {value!r}, expected an integer") from None


def real(name: str, value: Any) -> float:
    if not isinstance(value, numbers.Real):
        raise TypeError(f"{name}: found {value!r}, expected a number")
    return float(value)


def path_text(path: Any) -> str:
    try:
        return os.fsdecode(path)
    except TypeError:
        raise TypeError(f"path: found {path!r}, expected text or a path") from None


_PACKAGES = {"matplotlib": "python3-matplotlib", "pandas": "python3-pandas"}  # of Debian


def required(module: str) -> Any:
    """A module of a package that stiction does without until it is asked for. ImportError that says how to have it."""
    name = module.split(".")[0]
    try:
        return importlib.import_module(module)
    except ImportError as error:
        raise ImportError(f"stiction: found no {name}, expected it: install Debian's package {_PACKAGES[name]}, or "
                          f"pip install {name}") from error
