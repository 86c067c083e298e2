# SPDX-License-Identifier: Apache-2.0
"""Problems in factors: J, M, w, c as given, made the text of a problem file, and given back."""
from __future__ import annotations

import importlib
import json
from typing import Any, NamedTuple, Sequence

import numpy as np
from numpy.typing import NDArray

from ._given import exact_text, is_one, unmasked


class Entries(NamedTuple):
    """A sparse matrix where scipy is not installed: its entries, by the names of scipy's."""

    row: NDArray[np.int_]
    col: NDArray[np.int_]
    data: NDArray[np.float64]
    shape: tuple[int, int]

    def tocoo(self) -> Entries:
        return self

    def toarray(self) -> NDArray[np.float64]:
        dense = np.zeros(self.shape)
        np.add.at(dense, (self.row, self.col), self.data)
        return dense


def sparse(row: Any, col: Any, data: Any, shape: tuple[int, int]) -> Any:
    """A scipy.sparse.csr_matrix, or `Entries` where scipy is not installed."""
    try:
        csr_matrix = importlib.import_module("scipy.sparse").csr_matrix
    except ImportError:
        return Entries(np.asarray(row, dtype=int), np.asarray(col, dtype=int), np.asarray(data, dtype=float), shape)
    return csr_matrix((data, (row, col)), shape=shape)


def _number(value: Any, name: str) -> Any:
    """A double as it is, which JSON keeps; all else as exact text."""
    is_double = isinstance(value, float) and np.isfinite(value)
    return float(value) if is_double else exact_text(value, name)


def _numbers(values: Any, name: str) -> list[Any]:
    array = unmasked(values, name) if isinstance(values, np.ndarray) else np.array(values, dtype=object)
    if array.ndim != 1:
        raise ValueError(f"Problem: {name}: found {array.ndim} dimensions, expected 1")
    return [_number(x, f"Problem: {name}[{i}]") for i, x in enumerate(array.tolist())]


def _entries(matrix: Any, name: str) -> tuple[list[tuple[int, int, Any]], tuple[int, int]]:
    """Entries that are not zero, and the shape; of scipy's matrices, whose entries listed more than once add up, or
    of any that numpy takes."""
    if hasattr(matrix, "tocoo"):
        if hasattr(matrix, "tocsr"):
            matrix = matrix.tocsr(copy=True)
            matrix.sum_duplicates()
        coo = matrix.tocoo()
        listed = [(int(i), int(j), _number(x, f"Problem: {name}[{i}, {j}]"))
                  for i, j, x in zip(coo.row, coo.col, np.asarray(coo.data).tolist())]
        return listed, (int(coo.shape[0]), int(coo.shape[1]))
    array = unmasked(matrix, name) if isinstance(matrix, np.ndarray) else np.array(matrix, dtype=object)
    if array.ndim != 2:
        raise ValueError(f"Problem: {name}: found {array.ndim} dimensions, expected 2")
    listed = [(i, j, _number(x, f"Problem: {name}[{i}][{j}]"))
              for i, row in enumerate(array.tolist()) for j, x in enumerate(row) if x != 0]
    return listed, (array.shape[0], array.shape[1])


def _split(matrix: Any) -> list[Any]:
    """The blocks of M along its diagonal, as small as it falls into."""
    entries, (rows, columns) = _entries(matrix, "M")
    if rows != columns:
        raise ValueError(f"Problem: M: found {rows} x {columns}, expected a square matrix, a diagonal or blocks")
    last = list(range(rows))
    for i, j, _ in entries:
        last[min(i, j)] = max(last[min(i, j)], i, j)
    block_of, starts, end = [0] * rows, [], 0
    for k in range(rows):
        if k >= end:
            starts.append(k)
            end = k + 1
        end = max(end, last[k] + 1)
        block_of[k] = len(starts) - 1
    sizes = [b - a for a, b in zip(starts, [*starts[1:], rows])]
    blocks = [[["0"] * size for _ in range(size)] for size in sizes]
    for i, j, x in entries:
        k = block_of[i]
        blocks[k][i - starts[k]][j - starts[k]] = x
    return blocks


def _blocks(M: Any) -> list[Any]:
    if hasattr(M, "tocoo") or (isinstance(M, np.ndarray) and M.ndim == 2):
        return _split(M)
    if all(is_one(block) for block in M):
        return _numbers(M, "M")
    if all(not is_one(block) and all(is_one(x) for x in block) for block in M):
        return _split(M)
    blocks: list[Any] = []
    for k, block in enumerate(M):
        if is_one(block):
            blocks.append(_number(block, f"Problem: M[{k}]"))
            continue
        rows = np.array(block, dtype=object)
        if rows.ndim != 2:
            raise ValueError(f"Problem: M[{k}]: found {rows.ndim} dimensions, expected a number or 2")
        blocks.append([[_number(x, f"Problem: M[{k}]") for x in row] for row in rows.tolist()])
    return blocks


def document(J: Any, M: Any, w: Any, c: Any, contacts: Sequence[tuple[str, str, list[str]]], dimension: int,
             name: str) -> str:
    """The text of the problem file."""
    entries, shape = _entries(J, "J")
    factors = {"J": {"size": shape, "entries": entries}, "M": _blocks(M), "w": _numbers(w, "w")}
    if c is not None:
        factors["c"] = _numbers(c, "c")
    listed = []
    for kind, mu, slip in contacts:
        contact: dict[str, Any] = {"kind": kind}
        if kind in ("static", "sliding"):
            contact["mu"] = mu
        if slip:
            contact["slip"] = slip[0] if dimension == 2 and len(slip) == 1 else slip
        listed.append(contact)
    return json.dumps({"name": name, "dimension": dimension, "contacts": listed, "factors": factors})
