"""Writing a file whole or not at all."""

from __future__ import annotations

import os
import secrets
from pathlib import Path


def write_atomically(path: Path, data: bytes, *, durable: bool = True) -> None:
    """Replace the file at `path` in one step; its folder must be there.

    `durable` waits until the disk has it; without it a power cut, but no crash of the program, may undo it.

    Raises:
        OSError: the folder or the file cannot be written; the old file is then still there.
    """
    draft = path.with_name(f".{path.name}.{secrets.token_hex(4)}")  # beside it: a rename must not cross file systems
    try:
        with open(draft, "xb") as file:
            file.write(data)
            file.flush()
            if durable:
                os.fsync(file.fileno())
        os.replace(draft, path)
    except BaseException:
        draft.unlink(missing_ok=True)
        raise
