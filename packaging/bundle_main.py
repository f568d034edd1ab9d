"""What a bundle starts: the same as `rvsim`."""

import sys

from rvsim.cli import main

sys.exit(main())
