"""The experiments of the sources: what both the window and the command line offer."""

from rvsim.lab.lines import LinePreset, default_experiment, line_presets
from rvsim.lab.named_paths import NamedPath, line_of, named_path, path_entry, path_names
from rvsim.lab.path_file import read_path

__all__ = [
    "LinePreset",
    "NamedPath",
    "default_experiment",
    "line_of",
    "line_presets",
    "named_path",
    "path_entry",
    "path_names",
    "read_path",
]
