"""`python -m rvsim`."""

from rvsim.cli import run

run()
