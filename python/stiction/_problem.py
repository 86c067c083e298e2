# SPDX-License-Identifier: Apache-2.0
"""Problems, from arrays and from files."""
from __future__ import annotations

from fractions import Fraction
from typing import Any, Sequence

import numpy as np
from numpy.typing import NDArray

from . import _stiction
from ._factors import document, sparse
from ._given import Path, doubles, exact_text, integer, is_one, listed, path_text, require_text, shortened, unmasked


def _texts(A: NDArray[Any]) -> list[list[str]]:
    return [[exact_text(x, f"Problem: A[{i}][{j}]") for j, x in enumerate(row)] for i, row in enumerate(A)]


def _is_infinite(mu: Any) -> bool:
    return mu == "inf" if isinstance(mu, str) else isinstance(mu, (float, np.floating)) and float(mu) == float("inf")


def _read_infinite(kinds: list[str], mu: list[Any], slips: list[Any],
                   dimension: int) -> tuple[list[str], list[Any], list[Any]]:
    """A static contact without a bound on friction as files have it: a frictionless row, and bilateral ones."""
    contacts: list[tuple[str, Any, Any]] = []
    for contact in zip(kinds, mu, slips):
        if contact[0] == "static" and _is_infinite(contact[1]):
            contacts += [("frictionless", 0, None)] + [("bilateral", 0, None)] * (dimension - 1)
        else:
            contacts.append(contact)
    return tuple([contact[i] for contact in contacts] for i in range(3))  # type: ignore[return-value]


class Problem:
    """a = A f + b with contacts: rows are the normal of a contact, then its friction if it is static.

    A is rows x rows in 1/kg, b rows in m/s^2, mu one coefficient for each contact (0 where it has none) or one for
    all, kinds 'static', 'sliding', 'frictionless' or 'bilateral', by default all static. Of each contact that slides,
    slips has the direction: 1 or -1 in the plane, in space a unit vector of two exact numbers, as ('3/5', '4/5');
    of the others None. Arrays of doubles are read where they lie, those of integers and of shorter floating point
    after one conversion, and each double is the rational that it is; all else is taken exactly, number by number. A
    problem holds rationals. mu may be float('inf') or 'inf' of a contact that is static: then it holds by other
    contacts, a frictionless one and bilateral ones (corpus/formats/problems.md). A need not be symmetric, nor b in its range: `certify` says whether they are.

    In place of A and b may be given, by their names, J (rows x velocities), M, w (of each velocity) and c (of each row,
    by default zero): A = J inv(M) J', b = J w + c. J and M are matrices of scipy.sparse or of numpy; M may also be its
    diagonal, or a list of its blocks along it, and is symmetric and positive definite. Then A is not formed unless it is
    asked for, and there may be as many rows as memory holds.
    """

    def __init__(self, A: Any = None, b: Any = None, mu: Any = None, kinds: Sequence[str] | None = None,
                 dimension: int = 2, name: str = "problem", slips: Sequence[Any] | None = None, *, J: Any = None,
                 M: Any = None, w: Any = None, c: Any = None) -> None:
        require_text(name=name)
        if integer("dimension", dimension) not in (2, 3):
            raise ValueError(f"Problem: dimension: found {dimension}, expected 2 or 3")
        is_factored = J is not None
        for of, missing in (("A", not is_factored and A is None), ("b", not is_factored and b is None),
                            ("mu", mu is None), ("M", is_factored and M is None), ("w", is_factored and w is None)):
            if missing:
                raise TypeError(f"Problem: {of}: found nothing, expected {'J, M, w' if is_factored else 'A, b'} and mu")
        for of, beside in (("A", A), ("b", b)) if is_factored else (("M", M), ("w", w), ("c", c)):
            if beside is not None:
                raise TypeError(f"Problem: {of}: found beside {'J' if is_factored else 'A'}, expected A and b, or J, M, w")
        if not is_factored:
            A, b = (unmasked(x, name) if isinstance(x, np.ndarray) else np.array(x, dtype=object)
                    for x, name in ((A, "A"), (b, "b")))
            if A.ndim != 2 or b.ndim != 1:
                raise ValueError(f"Problem: found A with {A.ndim} and b with {b.ndim} dimensions, expected 2 and 1")
            if A.shape == (len(A), len(A)) != (len(b), len(b)):
                raise ValueError(f"Problem: b: found {len(b)} numbers, expected {len(A)}, one for each row of A")
        row_count = (J.shape[0] if hasattr(J, "shape") else len(J)) if is_factored else len(b)
        if isinstance(kinds, str):
            raise TypeError(f"kinds: found {kinds!r}, expected a sequence of names, one for each contact")
        if is_one(mu):
            count = len(kinds) if kinds is not None else row_count // dimension
            mu = [mu] * count
        mu = listed(mu, "mu")
        kinds = ["static"] * len(mu) if kinds is None else list(kinds)
        slips = [None] * len(kinds) if slips is None else list(slips)
        for of, found in (("mu", len(mu)), ("slips", len(slips))):
            if found != len(kinds):
                raise ValueError(f"Problem: {of}: found {found}, expected {len(kinds)}, one for each contact")
        for i, kind in enumerate(kinds):
            require_text(**{f"kinds[{i}]": kind})
        rows = sum(dimension if kind in ("static", "sliding") else 1 for kind in kinds)
        are_known = set(kinds) <= {"static", "sliding", "frictionless", "bilateral"}
        if not is_factored and are_known and A.shape != (rows, rows):
            raise ValueError(f"Problem: A: found {A.shape[0]} x {A.shape[1]}, expected {rows} x {rows}: {len(kinds)} "
                             f"contacts, as mu or kinds say, of {dimension} rows each where static or sliding, else "
                             f"of 1, with dimension={dimension}")
        kinds, mu, slips = _read_infinite(kinds, mu, slips, dimension)
        directions = [[] if slip is None else
                      [exact_text(x, f"Problem: slips[{i}]") for x in listed(slip, f"slips[{i}]")]
                      for i, slip in enumerate(slips)]
        contacts = [(kind, exact_text(x, f"Problem: mu[{i}]"), direction)
                    for i, (kind, x, direction) in enumerate(zip(kinds, mu, directions))]
        if is_factored:
            self._problem = _stiction.Problem.parse(document(J, M, w, c, contacts, dimension, name), "Problem")
            return
        exact_A, exact_b = doubles(A), doubles(b)
        self._problem = _stiction.Problem.from_numbers(
            _texts(A) if exact_A is None else exact_A,
            [exact_text(x, f"Problem: b[{i}]") for i, x in enumerate(b)] if exact_b is None else exact_b,
            contacts, dimension, name)

    @classmethod
    def from_bodies(cls, J: Any, M: Any, w: Any, mu: Any, c: Any = None, kinds: Sequence[str] | None = None,
                    dimension: int = 2, name: str = "problem", slips: Sequence[Any] | None = None) -> Problem:
        """The problem of bodies: J is rows x velocities, M velocities x velocities in kg (or kg m^2), its diagonal or
        its blocks, w (of each velocity) and c (of each row) such that b = J w + c in m/s^2; all else as of `Problem`."""
        return cls(J=J, M=M, w=w, c=c, mu=mu, kinds=kinds, dimension=dimension, name=name, slips=slips)

    @property
    def name(self) -> str:
        """Of the problem file."""
        return self._problem.name

    @property
    def dimension(self) -> int:
        """2 in the plane, 3 in space."""
        return self._problem.dimension

    @property
    def A(self) -> NDArray[np.float64]:
        """rows x rows in 1/kg at its nearest doubles: a view of the problem's memory, which cannot be written to."""
        return self._problem.A

    @property
    def b(self) -> NDArray[np.float64]:
        """Likewise, rows in m/s^2."""
        return self._problem.b

    @property
    def J(self) -> Any:
        """Of a problem in factors, rows x velocities at its nearest doubles: a csr_matrix of scipy, without scipy its
        entries by the same names (row, col, data, shape); otherwise None."""
        factors = self._problem.factors()
        return None if factors is None else sparse(*factors[0])

    @property
    def M(self) -> Any:
        """Likewise, velocities x velocities in kg or kg m^2."""
        factors = self._problem.factors()
        return None if factors is None else sparse(*factors[1])

    @property
    def w(self) -> NDArray[np.float64] | None:
        """Likewise, an array, of each velocity."""
        factors = self._problem.factors()
        return None if factors is None else factors[2]

    @property
    def c(self) -> NDArray[np.float64] | None:
        """Likewise, in m/s^2, of each row."""
        factors = self._problem.factors()
        return None if factors is None else factors[3]

    @property
    def exact_A(self) -> list[list[Fraction]]:
        """A itself; a copy."""
        return [[Fraction(x) for x in row] for row in self._problem.exact_A()]

    @property
    def exact_b(self) -> list[Fraction]:
        """b itself; a copy."""
        return [Fraction(x) for x in self._problem.exact_b()]

    @property
    def mu(self) -> list[Fraction]:
        """Of each contact, exactly."""
        return [Fraction(x) for x in self._problem.exact_mu()]

    @property
    def kinds(self) -> list[str]:
        """Of each contact."""
        return self._problem.kinds()

    @property
    def slips(self) -> list[tuple[Fraction, ...] | None]:
        """Of each contact that slides its direction, of one component in the plane and two in space."""
        return [tuple(Fraction(x) for x in slip) or None for slip in self._problem.exact_slips()]

    def rounded(self, arithmetic: str = "double") -> Problem:
        """As 'float' or 'double' holds it, number by number; ValueError names one that is too large or too small."""
        if arithmetic not in ("float", "double"):
            raise ValueError(f"rounded: arithmetic: found {arithmetic!r}, expected float or double")
        return wrapped(self._problem.rounded(arithmetic == "float"))

    @property
    def digest(self) -> str:
        """Of all that is exact in it, as certificates name it."""
        return self._problem.digest()

    def __repr__(self) -> str:
        counts = ", ".join(f"{self.kinds.count(kind)} {kind}" for kind in dict.fromkeys(self.kinds)) or "none"
        return (f"<stiction.Problem {shortened(self.name)!r}, {'in the plane' if self.dimension == 2 else 'in space'}, "
                f"contacts: {counts}, {len(self.b)} rows>")

    def __eq__(self, other: object) -> bool:
        """The same numbers and contacts exactly; names may differ."""
        if not isinstance(other, Problem):
            return NotImplemented
        return self.digest == other.digest

    def __hash__(self) -> int:
        return hash(self.digest)

    def __reduce__(self) -> tuple[Any, ...]:  # for pickle and copy: the text of its file
        return parsed, (self._problem.text(), "a pickled problem")

    def save(self, path: Path) -> None:
        """Writes a problem file, whole or not at all."""
        self._problem.save(path_text(path))


def load(path: Path) -> Problem:
    """The problem of a file, in any form that `stiction solve` takes, but standard input."""
    file = path_text(path)
    if ":" not in file:  # STORE:FINDING
        with open(file, "rb"):  # OSError where it cannot be opened
            pass
    return wrapped(_stiction.Problem.read(file))


def parsed(text: str, source: str) -> Problem:
    """The problem of a problem file's text."""
    return wrapped(_stiction.Problem.parse(text, source))


def wrapped(compiled_problem: _stiction.Problem) -> Problem:
    problem = Problem.__new__(Problem)
    problem._problem = compiled_problem
    return problem


def compiled(problem: Any, by: str) -> _stiction.Problem:
    if not isinstance(problem, Problem):
        raise TypeError(f"{by}: problem: found {shortened(repr(problem))}, expected a stiction.Problem, as "
                        "stiction.Problem(A, b, mu) and stiction.load(path) make")
    return problem._problem
