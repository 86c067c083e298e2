# SPDX-License-Identifier: Apache-2.0
"""Tables and numbers in Markdown."""

import decimal
import re
import textwrap

import intervals

WIDTH = 118


def table(head, rows):
    lines = [head, ["---"] * len(head), *rows]
    return "\n".join("| " + " | ".join(str(cell) for cell in line) + " |" for line in lines)


def prose(text):
    """Lines of a width; a command is never broken inside its quotes where that can be helped."""
    parts = text.split("`")
    glued = [part.replace(" ", "\0") if i % 2 and len(part) < WIDTH else part for i, part in enumerate(parts)]
    lines = textwrap.wrap("`".join(glued), WIDTH, break_long_words=False, break_on_hyphens=False)
    return "\n".join(lines).replace("\0", " ")


def commands(typed):
    """The last lines of a block: what made it."""
    return prose("Made by " + ", ".join(f"`{command}`" for command in typed) + ".")


def front_matter(content):
    """The facts in front of a text, and the text."""
    found = re.match(r"---\n(.*?)\n---\n\n", content, re.S)
    if not found:
        return {}, content
    return dict(line.split(": ", 1) for line in found[1].splitlines() if ": " in line), content[found.end():]


def count(number):
    return f"{number:,}"


def three(number):
    """Three digits, thousands separated."""
    if number >= 100:
        digits = len(str(int(number)))
        return f"{round(number, 3 - digits):,.0f}"
    return f"{number:.3g}" if number else "0"


def spread(values, digits=three):
    """A median between its quartiles, or between the least and the most."""
    low, median, high = map(digits, values)
    return f"{median} ({low} - {high})"


def digits_of(number, digits):
    """So many digits, thousands separated; whole numbers below a thousand are exact."""
    if number == round(number) and number < 1000:
        return f"{number:.0f}"
    if digits == 3 or number == 0:
        return three(number)
    if number < 1000 - 500 * 10.0 ** -digits:
        return f"{number:#.{digits}g}"
    left = digits - len(str(round(number)))
    return f"{round(number, left):,.{max(left, 0)}f}"


def outward(end, digits, rounding):
    """The end of an interval in so many digits; a number that has no more stays."""
    if end == 0:
        return digits_of(end, digits)
    exact = decimal.Decimal(f"{end:.15g}")
    step = decimal.Decimal(1).scaleb(exact.adjusted() + 1 - digits)
    return digits_of(float((exact / step).to_integral_value(rounding) * step), digits)


def with_ends(value, low, high, unit=""):
    """A value and its interval, outward, in three digits or as many as tell the ends from it."""
    digits = 3
    while digits < 15 and any(end != value and f"{end:.{digits}g}" == f"{value:.{digits}g}" for end in (low, high)):
        digits += 1
    return (f"{digits_of(value, digits)}{unit} [{outward(low, digits, decimal.ROUND_FLOOR)}, "
            f"{outward(high, digits, decimal.ROUND_CEILING)}]")


def rate(number, of, unit=1_000_000):
    """How many of `number` a million, with Garwood's interval."""
    low, high = (end * unit / of for end in intervals.garwood(number))
    return with_ends(number * unit / of, low, high)


def share(number, of):
    """A part in percent, with the interval of Clopper and Pearson."""
    if of == 0:
        return "-"
    low, high = intervals.clopper_pearson(number, of)
    return with_ends(100 * number / of, 100 * low, 100 * high, " %")
