# SPDX-License-Identifier: Apache-2.0
"""The optimizers of a search beside random problems, by objective, each with the same number of evaluations.

A gain says how many times worse for the solver an optimizer's best is than the best of random problems: the quotient
of the values, or 10^difference where they are logarithms; `inf` where random problems have no value, `-` where neither
has, 0 where only random ones have."""

import math
import os
import tempfile

import stiction
import study

OPTIMIZERS = ("evolution", "nlopt", "continuation")
# Objective, generator, contacts, mu, evaluations: about as long each, so what is run exactly has fewer.
TRIALS = [("steps", "psd", 4, 1, 24000), ("steps-per-contact", "psd", 3, 1, 24000),
          ("zero-steps", "integers", 4, 1, 24000), ("zero-run", "integers", 4, 1, 24000),
          ("give-ups", "psd", 4, 1, 24000), ("memory", "psd", 4, 1, 24000),
          ("scans", "psd", 4, 1, 24000), ("period", "psd", 3, 1, 24000), ("start", "psd", 3, 1, 24000),
          ("distance", "psd", 2, "1/4", 24000), ("pivot", "psd", 3, 1, 24000), ("bits", "psd", 3, 1, 4000),
          ("condition", "psd", 2, 1, 24000), ("friction", "scenes", 4, 1, 24000), ("rounding", "psd", 3, 1, 4000),
          ("policies", "psd", 2, 1, 600), ("ipopt", "psd", 2, 1, 300), ("folds", "psd", 4, 1, 16000),
          ("descents", "psd", 4, 1, 16000), ("pieces", "psd", 4, 1, 16000), ("solutions", "psd", 3, 1, 300),
          ("margin", "psd", 2, 1, 24000), ("radius", "psd", 2, 1, 8000)]
LOW, DECADES = ("distance", "condition", "friction"), ("pivot", "rounding")  # the best is the least; a logarithm


def best_of(trial, optimizer, evaluations, seed):
    """The best value; None where there is none. Four units, each from the best of those before."""
    objective, generator, contacts, mu, _ = trial
    with tempfile.TemporaryDirectory() as folder:
        store = os.path.join(folder, "a.store")
        # Of three contacts and more a unit has half as many problems for each contact.
        for _ in stiction.search(generator, contacts, mu, evaluations, seed, objective=objective, optimizer=optimizer,
                                 unit_problems=max(1, evaluations // 4) << max(0, contacts - 2), store=store, threads=1,
                                 finishing=0):
            pass
        best = stiction.Store(store).best
    return best[0].value if best else None


def gain(objective, value, random):
    if value is None or random is None:
        return math.nan if random is None and value is None else math.inf if random is None else 0.0
    if objective in DECADES:
        return 10 ** (value - random)
    worse, other = (random, value) if objective in LOW else (value, random)
    return worse / other if other else 1.0 if worse == 0 else math.inf


def main():
    o = study.options(__doc__, objective=[trial[0] for trial in TRIALS], problems=24000, seed=1)
    rows, doubled = [], dict.fromkeys(OPTIMIZERS, 0)
    for trial in (trial for trial in TRIALS if trial[0] in o.objective):
        evaluations = min(o.problems, trial[4])
        random = best_of(trial, "random", evaluations, o.seed)
        gains = {name: gain(trial[0], best_of(trial, name, evaluations, o.seed), random) for name in OPTIMIZERS}
        for name, value in gains.items():
            doubled[name] += value >= 2
        rows.append((trial[0], f"{trial[1]} {trial[2]}", evaluations, "-" if random is None else random,
                     *("-" if math.isnan(value) else value for value in gains.values())))
    head = ["objective", "problems", "evaluations", "best of random", *(f"gain of {name}" for name in OPTIMIZERS)]
    study.show(head, rows)
    print("At least twice as bad for the solver as random problems:",
          "; ".join(f"{name} in {count} of {len(rows)}" for name, count in doubled.items()))


study.run(main)
