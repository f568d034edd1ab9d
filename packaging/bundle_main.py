"""What a bundle starts: the same as `rvsim`."""

from rvsim.cli import run

run()
