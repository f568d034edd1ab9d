"""Two commands that do all the set-up: `python3 packaging/dev.py run` and `python3 packaging/dev.py test`.

Needs nothing but Python 3.11 or newer. This file holds the door: it must be readable by an old Python too, so that an
old Python gets a sentence and not a SyntaxError. What the commands do is in dev_commands.py, how the environment is
made in dev_environment.py, what the operating system must bring in dev_system.py.
"""

import sys

USAGE = """usage: python3 packaging/dev.py COMMAND [arguments]

  run    start rvsim; arguments are passed on to it
  test   run every check: ruff, mypy, and the tests without and with OpenGL; arguments are passed on to pytest
  bench  measure the speed of rvsim against other libraries; arguments name benchmarks, for instance: forward
  soak   run the long random tests; arguments name them, and options are passed on, for instance: --count 10000
  bundle make programs that run without Python, for computers like this one, in dist; test them, weigh and time them
  texts  bring the translations in resources/languages up to date with the code, and say how many are missing
  wheel  make a wheel and an sdist in dist, install each into a new environment, and test them there

The first use makes .venv in this folder and installs everything there; nothing outside this folder is touched,
except for system packages when you are root on Debian or Ubuntu."""

OLDEST = (3, 11)


def refusal(version: "tuple[int, ...]", newer: "str | None") -> "str | None":
    """Why this Python cannot be used, with what would work instead; None when it can."""
    if version >= OLDEST:
        return None
    advice = "Install a newer Python (https://www.python.org/downloads/) and use that one."
    if newer:
        advice = f"There is a newer one; type: {newer} packaging/dev.py run"
    return (
        f"rvsim needs Python {OLDEST[0]}.{OLDEST[1]} or newer, and this is Python {version[0]}.{version[1]}. {advice}"
    )


def newer_python() -> "str | None":
    """The name of a Python on the PATH that is new enough and starts, or None."""
    from shutil import which
    from subprocess import DEVNULL, call

    names = [f"python3.{minor}" for minor in range(20, OLDEST[1] - 1, -1)]
    starts = (name for name in names if which(name) and call([name, "-c", ""], stderr=DEVNULL) == 0)
    return next(starts, None)


def main(arguments: "list[str]") -> None:
    version = sys.version_info[:2]
    problem = refusal(version, newer_python() if version < OLDEST else None)
    if problem:
        sys.exit(problem)
    import dev_commands

    command = arguments[0] if arguments else ""
    if command not in dev_commands.COMMANDS:
        print(USAGE)
        sys.exit(0 if command in ("-h", "--help") else 2)
    sys.exit(dev_commands.start(command, arguments[1:]))


if __name__ == "__main__":
    main(sys.argv[1:])
