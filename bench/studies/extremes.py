# SPDX-License-Identifier: Apache-2.0
"""Speed against accuracy along dials, families with one number that is turned: masses, levers, units, conditioning,
friction, ...: what `trade` measures on the generators. --families names some of them."""

import study
import trade


def main():
    o = study.options(__doc__, families=[""], problems=25, seed=1, csv="", json=False)
    trade.tell(o, trade.sources(o, *(["--families", *o.families] if o.families != [""] else [])))


study.run(main)
