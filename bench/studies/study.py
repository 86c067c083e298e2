# SPDX-License-Identifier: Apache-2.0
"""What the studies share: their options, and tables in Markdown."""

import argparse
import sys

import numpy as np

import stiction


def options(text, **defaults):
    """The command line of a study: --name for every default, several values for a list, a flag for False."""
    parser = argparse.ArgumentParser(description=text, formatter_class=argparse.RawDescriptionHelpFormatter)
    for name, value in defaults.items():
        flag = f"--{name.replace('_', '-')}"
        if value is False:
            parser.add_argument(flag, action="store_true")
        elif isinstance(value, list):
            parser.add_argument(flag, nargs="+", default=value, type=type(value[0]),
                                help=f"default {' '.join(map(str, value))}")
        else:
            parser.add_argument(flag, default=value, type=type(value), help=f"default {value}")
    return parser.parse_args()


def run(main):
    """Exit code 2, and a line, where what is asked for cannot be had."""
    try:
        main()
    except ValueError as error:
        print(f"{sys.argv[0]}: {error}", file=sys.stderr)
        sys.exit(2)


def show(head, rows):
    """A table."""
    for line in (head, ["---"] * len(head), *rows):
        print("| " + " | ".join(number(cell) for cell in line) + " |")
    print(flush=True)


def chunks(problems, size=1000):
    """(first, count) of parts of so many problems; on a terminal it says how far it is."""
    for first in range(0, problems, size):
        if sys.stderr.isatty():
            end = "\r\033[K" if first + size >= problems else ""
            print(f"\r\033[K{first:,} of {problems:,}", end=end, file=sys.stderr, flush=True)
        yield first, min(size, problems - first)


def number(x):
    """Text as it is, whole numbers in full, others in three digits."""
    if isinstance(x, (float, np.floating)):
        return f"{x:,.0f}" if abs(x) >= 1000 else f"{x:.3g}"
    return f"{x:,}" if isinstance(x, (int, np.integer)) else str(x)


def within(value, ends, unit=""):
    return f"{number(float(value))}{unit} [{', '.join(number(float(end)) for end in ends)}]"


def share(count, of):
    """In percent, with its exact interval at 95 %."""
    return within(100 * count / of, (100 * end for end in stiction.interval(count, of)), " %") if of else "-"


def rate(count, of):
    """In a million, likewise."""
    return within(1e6 * count / of, (1e6 * end / of for end in stiction.interval(count)))


def times(values):
    """Median and 90 % quantile."""
    return f"{number(float(np.median(values)))} ({number(float(np.quantile(values, 0.9)))})" if len(values) else "-"
