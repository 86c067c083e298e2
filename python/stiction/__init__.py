# SPDX-License-Identifier: Apache-2.0
"""stiction: contact forces with friction by pivoting, from Python.

Names are those of the command line. Forces, accelerations and problems are arrays of numpy at their nearest doubles,
f, a, A, b; beside each stands what is exact, as fractions.Fraction: exact_f, exact_a, exact_A, exact_b. Bad input, a
place to write that is none among it, is a ValueError with the program's one line; what is of another type a TypeError;
a file that cannot be opened, and a full disk, an OSError.
"""
from pathlib import Path as _Path

try:
    from . import _stiction
except ImportError as error:
    if list(_Path(__file__).parent.glob("_stiction*.so")):
        raise  # it is there, and cannot be loaded: by another interpreter, or without a library
    raise ImportError(f"stiction: found no compiled module in {_Path(__file__).parent}, expected a build: "
                      "'./run python' makes one and starts Python, 'pip install .' installs one") from None
from . import plots  # which imports nothing of others before it draws
from ._campaigns import Best, Finding, Store, draw, interval, search
from ._explained import Explanation, explain, methods, policies
from ._many import Answers, replay_many, solve_many
from ._methods import (Answer, Certificate, Decision, Pivot, Replay, certify, check, decide, ends, replay, solve,
                       solve_all)
from ._problem import Problem, load
from ._simulation import Simulation, assemble, simulate
from ._stiction import __version__

__all__ = ["Answer", "Answers", "Best", "Certificate", "Decision", "Explanation", "Finding", "Pivot", "Problem",
           "Replay", "Simulation", "Store", "assemble", "certify", "check", "decide", "draw", "ends", "explain",
           "interval", "load", "methods", "policies", "replay", "replay_many", "search", "simulate", "solve", "solve_all",
           "solve_many"]  # and __version__, and the module plots

for _name in __all__:
    globals()[_name].__module__ = __name__  # as which they are named where they are shown
del _name
