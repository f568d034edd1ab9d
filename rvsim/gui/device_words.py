"""The state of an arm on a wire in words, and how serious it is."""

from __future__ import annotations

from rvsim.device.driver.state import DriverState, Phase
from rvsim.language import tr, tr_later

_WORDS: dict[Phase, str] = {
    "disconnected": tr_later("Not connected"),
    "connecting": tr_later("Connecting …"),
    "asleep": tr_later("Connected, asleep"),
    "ready": tr_later("Ready"),
    "moving": tr_later("Moving"),
    "streaming": tr_later("Following"),
    "running": tr_later("Running"),
    "stopped": tr_later("STOPPED"),
    "lost": tr_later("Connection lost"),
}
_LEVELS: dict[Phase, str] = {
    "asleep": "warning", "ready": "good", "moving": "good", "streaming": "good", "running": "good",
    "stopped": "error", "lost": "error",
}  # fmt: skip

LANGUAGE_WORDS = {"ssc32": tr_later("SSC-32, SSC-32U"), "bridge": tr_later("Encoder bridge")}


def baud_words(rate: int) -> str:
    """How fast a wire is [bit/s]."""
    return tr("{rate} baud", rate=rate)


def phase_words(state: DriverState | None, title: str) -> str:
    """A line for the panel and the status bar: "Virtual AL5B: ready"."""
    if state is None:
        return tr(_WORDS["disconnected"])
    words = tr(_WORDS[state.phase])
    if state.phase == "running":
        words = tr("Running, {time:.1f} of {duration:.1f} s", time=state.time, duration=state.duration)
    return tr("{arm}: {state}", arm=tr(title), state=words) if title else words


def phase_level(phase: str) -> str:
    """ "good", "warning", "error", or "" for what is neither."""
    return {str(key): level for key, level in _LEVELS.items()}.get(phase, "")
