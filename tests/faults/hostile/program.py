#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Solvers under test that mean no good: the name under which this file is called says what it does (hostile_test.py)."""

import json
import os
import resource
import signal
import sys
import time

NAME = os.path.basename(sys.argv[0])
MARK = os.environ.get("HOSTILE_MARK", "0")  # the argument of every helper
OUT = sys.stdout.buffer


def write(data):
    OUT.write(data)
    OUT.flush()


def say(value):
    write(json.dumps(value).encode() + b"\n")


def forces(problem):
    """Right ones of contacts that A does not couple."""
    return [max(0.0, -b / row[i]) if row[i] > 0 else 0.0 for i, (row, b) in enumerate(zip(problem["A"], problem["b"]))]


def answer(problem):
    say({"solved": True, "f": forces(problem)})


def sleep(*_):
    while True:
        time.sleep(1000)


def spin(*_):
    while True:
        pass


def helper(session=False, twice=False, clean=False, quiet=False):
    """A process that sleeps; `session`: in one of its own; `twice`: an orphan; `clean`: with nothing in its environment."""
    if os.fork():
        return
    if session:
        os.setsid()
    if twice and os.fork():
        os._exit(0)
    if quiet:
        os.closerange(0, 3)
    signal.signal(signal.SIGTERM, signal.SIG_IGN)
    os.execve("/bin/sleep", ["sleep", MARK], {} if clean else dict(os.environ))


def with_helper(**how):
    def act(problem):
        helper(**how)
        answer(problem)
    return act


def after(*actions):
    def act(problem):
        for action in actions:
            action(problem)
    return act


def close_both(*_):
    os.close(0)
    os.close(1)


def exits(status):
    return lambda *_: os._exit(status)


def dies(number):
    return lambda *_: os.kill(os.getpid(), number)


def raw(data):
    return lambda *_: write(data)


def flood(stream, piece):
    def act(*_):
        while True:
            os.write(stream, piece)
    return act


def noisy(stream, piece, times):
    def act(problem):
        for _ in range(times):
            os.write(stream, piece)
        answer(problem)
    return act


def says(*forces_as_text):
    def act(problem):
        numbers = ", ".join(forces_as_text[i % len(forces_as_text)] for i in range(len(problem["b"])))
        write(b'{"solved": true, "f": [' + numbers.encode() + b"]}\n")
    return act


def stop_itself(*_):
    os.kill(os.getpid(), signal.SIGSTOP)
    sleep()


def parent(number):
    def act(problem):
        os.kill(os.getppid(), number)
        time.sleep(0.2)
        answer(problem)
    return act


def kills_parent_and_leaves(problem):
    helper(session=True, twice=True)
    os.kill(os.getppid(), signal.SIGKILL)
    sleep()


def ignores(problem):
    for number in (signal.SIGTERM, signal.SIGINT, signal.SIGHUP):
        signal.signal(number, signal.SIG_IGN)
    sleep()


def grows(problem):
    kept = []
    while True:
        kept.append(bytearray(1 << 24))


def terminal(problem):
    for name in ("/dev/tty", "/proc/self/fd/2"):
        try:
            with open(name, "wb", buffering=0) as file:
                file.write(b"\x1b[2J\x1b]0;taken\x07\r HOSTILE \r\n")
        except OSError:
            pass
    answer(problem)


def threads(problem):
    import threading  # none of the others waits for it
    threading.Thread(target=sleep).start()
    threading.Thread(target=spin, daemon=True).start()
    answer(problem)


def late(problem):
    answer(problem)
    if not os.fork():
        time.sleep(0.01)
        say({"solved": True, "f": [1e3] * len(problem["b"])})
        os._exit(0)


previous = []


def answers_previous(problem):
    previous.append(problem)
    answer(previous[-2] if len(previous) > 1 else {"A": [], "b": []})


def by_time(problem):
    say({"solved": time.time_ns() // 1000 % 2 == 0, "f": [time.time_ns() % 7] * len(problem["b"])})


leaked = []


def leaks(problem):
    leaked.append(bytes(100_000))
    answer(problem)


def by_a_child(problem):
    child = os.spawnv(os.P_NOWAIT, "/bin/sleep", ["sleep", MARK])
    os.waitpid(child, 0)


NESTED = b'{"solved": true, "f": ' + b"[" * 400_000 + b"]" * 400_000 + b"}\n"

ACTS = {
    "answers": answer,
    "closes-and-lives": after(close_both, sleep),
    "closes-and-spins": after(close_both, spin),
    "closes-output": after(lambda *_: os.close(1), sleep),
    "closes-after-answer": after(answer, close_both, sleep),
    "ignores-signals": ignores,
    "floods-lines": flood(1, b"hm\n" * 20000),
    "floods-without-lines": flood(1, b"x" * 60000),
    "floods-errors": flood(2, b"hm\n" * 20000),
    "floods-errors-without-lines": flood(2, b"x" * 60000),
    "many-errors": noisy(2, b"trouble\n" * 100, 20),
    "million-nan": lambda *_: write(b'{"solved": true, "f": [' + b"NaN, " * 1_000_000 + b"NaN]}\n"),
    "many-nan": lambda *_: write(b'{"solved": true, "f": [' + b"NaN, " * 200_000 + b"NaN]}\n"),
    "hundred-megabytes": lambda *_: write(b"y" * 100_000_000 + b"\n"),
    "child-holds-output": after(lambda *_: helper(), exits(0)),
    "child-outlives": with_helper(),
    "child-in-session": with_helper(session=True),
    "daemon": with_helper(session=True, twice=True, quiet=True),
    "daemon-without-marks": with_helper(session=True, twice=True, clean=True, quiet=True),
    "sleeps": sleep,
    "sleeps-by-a-child": by_a_child,
    "spins": spin,
    "half-json": raw(b"{\n"),
    "text": raw(b"I do not know\n"),
    "empty-lines": raw(b"\n"),
    "carriage-returns": raw(b'{"solved": false}\r\n'),
    "nan": says("NaN"),
    "infinity": says("-Infinity"),
    "beyond-doubles": says("1e999"),
    "long-digits": says("1" * 400_000),
    "texts": says('"1"'),
    "too-many": raw(b'{"solved": true, "f": [' + b"0, " * 50 + b"0]}\n"),
    "too-few": raw(b'{"solved": true, "f": []}\n'),
    "half-line-and-sleep": after(raw(b'{"solved": tr'), sleep),
    "half-line-and-exit": after(raw(b'{"solved": tr'), exits(0)),
    "forges": lambda problem: say({"solved": True, "f": [0.0] * len(problem["b"])}),
    "wrong-types": raw(b'{"solved": "yes", "f": {"0": 1}}\n'),
    "says-it-twice": raw(b'{"solved": true, "solved": false, "f": 7}\n'),
    "nul-bytes": raw(b'{"solved": true, "f": [\0]}\n'),
    "no-utf8": raw(b'{"solved": true, "f": ["\xff\xfe"]}\n'),
    "nested": raw(NESTED),
    "exits-well": exits(0),
    "exits-with-3": exits(3),
    "exits-after-answer": after(answer, exits(0)),
    "dies-of-segv": dies(signal.SIGSEGV),
    "dies-of-kill": dies(signal.SIGKILL),
    "kills-its-group": lambda *_: os.kill(0, signal.SIGKILL),
    "kills-its-parent": parent(signal.SIGKILL),
    "kills-its-parent-and-leaves": kills_parent_and_leaves,
    "stops-its-parent": parent(signal.SIGSTOP),
    "ends-its-parent": parent(signal.SIGTERM),
    "stops-itself": stop_itself,
    "grows": grows,
    "terminal": terminal,
    "by-time": by_time,
    "answers-twice": after(answer, answer),
    "answers-late": late,
    "answers-previous": answers_previous,
    "threads": threads,
    "execs": lambda *_: os.execv("/bin/sleep", ["sleep", MARK]),
    "leaks": leaks,
    "slow": after(lambda *_: time.sleep(0.3), answer),
    "reads-nothing": None,
    "speaks-unasked": None,
    "another-each-time": answer,
    "greets-no-more": answer,
}


def main():
    resource.setrlimit(resource.RLIMIT_NOFILE, (256, 256))
    greeting = {"protocol": 1, "solver": NAME, "version": "1", "law": "frictionless", "accuracy": 1e-6}
    if NAME == "another-each-time":
        greeting["version"] = str(os.getpid())
    if NAME == "greets-no-more":  # after the first two: those that ask what it is
        count = os.path.join(os.environ["HOSTILE_FOLDER"], "greetings")
        with open(count, "a+b") as file:
            file.write(b"x")
            if file.tell() > 2:
                sleep()
    say(greeting)
    if NAME == "reads-nothing":
        sleep()
    if NAME == "speaks-unasked":
        while True:
            say({"solved": False})
    for line in sys.stdin:
        ACTS[NAME](json.loads(line))


if __name__ == "__main__":
    main()
