"""What the check of a path found, as sentences: a symbol and a word for how grave it is, then what, where and why."""

from __future__ import annotations

import math

from rvsim.lab.sentences import Units, joint_amount, joint_words, length_number, stretch_reason
from rvsim.language import left_to_right, tr, tr_later, trn
from rvsim.motion.honesty import Finding, FindingKind, Report, Severity
from rvsim.robot import Robot

SYMBOLS: dict[Severity, str] = {"good": "✓", "warning": "▲", "bad": "✗"}
WORDS: dict[FindingKind, str] = {
    "reach": tr_later("Reach"),
    "missed": tr_later("Missed"),
    "jump": tr_later("Jump"),
    "speed": tr_later("Speed"),
    "acceleration": tr_later("Acceleration"),
    "pace": tr_later("Time"),
    "singular": tr_later("Singularity"),
    "table": tr_later("Table"),
    "own": tr_later("Itself"),
}
_RATES = {"speed": "/s", "acceleration": "/s²"}


def finding_sentence(report: Report, finding: Finding, units: Units) -> str:
    """A sentence about one finding."""
    return {
        "reach": _reach,
        "missed": _missed,
        "jump": _jump,
        "speed": _rate,
        "acceleration": _rate,
        "pace": _pace,
        "singular": _singular,
        "table": _table,
        "own": _own,
    }[finding.kind](report, finding, units)


def summary_sentence(report: Report) -> str:
    """The verdict on all of it."""
    worst = sum(finding.severity == "bad" and finding.kind != "reach" for finding in report.findings)
    if report.severity == "good":
        return tr("Nothing speaks against running it.")
    if not worst:
        return tr("It can be run; mind the warnings.")
    return trn("Not as it is: one thing is wrong.", "Not as it is: {n} things are wrong.", worst)


def where_words(finding: Finding) -> str:
    """Which points: "point 7", "points 7–9", "on the way to the path"."""
    if finding.index is None:
        return tr("on the way to the path")
    last = finding.index if finding.last is None else finding.last
    if last == finding.index:
        return tr("at point {number}", number=last + 1)
    return tr("points {first}\u2013{last}", first=finding.index + 1, last=last + 1)


def link_name(robot: Robot, link: int) -> str:
    """ "the base", "link 3 (behind the elbow)"."""
    if link == 0:
        return tr("the base")
    return tr("link {number} (behind {joint})", number=link, joint=joint_words(robot.joint_names[link - 1]))


def _reach(report: Report, finding: Finding, _units: Units) -> str:
    tracking = report.tracking
    if tracking.complete:
        return tr("All: {reached} of {all} points reached.", reached=tracking.reached_count, all=tracking.samples)
    return tr(
        "{share:.0f} %: {reached} of {all} points reached.",
        share=100.0 * finding.value,
        reached=tracking.reached_count,
        all=tracking.samples,
    )


def _missed(report: Report, finding: Finding, units: Units) -> str:
    why = stretch_reason(report.robot, list(finding.points), units)
    if finding.index is None:
        return tr("On the way to the path: {why}.", why=why)
    last = finding.index if finding.last is None else finding.last
    if last == finding.index:
        return tr("Point {number}: {why}.", number=last + 1, why=why)
    return tr("Points {first}\u2013{last}: {why}.", first=finding.index + 1, last=last + 1, why=why)


def _jump(_report: Report, finding: Finding, _units: Units) -> str:
    assert finding.index is not None
    before, after = finding.index + 1, finding.index + 2
    if finding.severity == "good":
        return tr(
            "From point {before} to {after} the arm changes its branch with the pen lifted.", before=before, after=after
        )
    return tr(
        "From point {before} to {after} the arm changes its branch; the tool leaves the path there.",
        before=before,
        after=after,
    )


def _rate(report: Report, finding: Finding, units: Units) -> str:
    assert finding.joint is not None
    value, limit = (_rate_text(report.robot, finding, value, units) for value in (finding.value, finding.limit))
    text = (
        tr_later("At most {share:.0f} %: {joint} {where}, {value} of the assumed {limit}.")
        if finding.assumed
        else tr_later("At most {share:.0f} %: {joint} {where}, {value} of the {limit}.")
    )
    return tr(
        text,
        share=100.0 * finding.value / finding.limit,
        joint=tr(report.robot.joint_names[finding.joint]),
        where=where_words(finding),
        value=value,
        limit=limit,
    )


def _pace(report: Report, finding: Finding, _units: Units) -> str:
    assert finding.joint is not None
    text = (
        tr_later(
            "Slowed down where a joint needs it, most of all {joint} {where}: {seconds:.2f} s instead of the "
            "{asked:.2f} s asked for."
        )
        if finding.severity == "good"
        else tr_later(
            "{joint} {where} cannot go so fast, so all of it is slowed down: {seconds:.2f} s instead of the "
            "{asked:.2f} s asked for."
        )
    )
    joint = tr(report.robot.joint_names[finding.joint])
    return _capital(tr(text, joint=joint, where=where_words(finding), seconds=finding.value, asked=finding.limit))


def _rate_text(robot: Robot, finding: Finding, value: float, units: Units) -> str:
    assert finding.joint is not None
    text = joint_amount(robot, robot.joint_names[finding.joint], value, units)
    return f"{text}{_RATES[finding.kind]}"


def _singular(_report: Report, finding: Finding, _units: Units) -> str:
    return tr(
        _CLOSENESS[bool(finding.family)][finding.severity],
        least=_number(finding.value),
        share=_number(finding.limit),
        where=where_words(finding),
        family=tr(finding.family),
    )


_CLOSENESS: dict[bool, dict[Severity, str]] = {
    False: {
        "good": tr_later("σ min is at least {least}, {share} of σ max, {where}."),
        "warning": tr_later("σ min is at least {least}, {share} of σ max, {where}; close."),
        "bad": tr_later("σ min is at least {least}, {share} of σ max, {where}; as good as singular."),
    },
    True: {
        "good": tr_later("σ min is at least {least}, {share} of σ max, {where}: the {family} singularity."),
        "warning": tr_later("σ min is at least {least}, {share} of σ max, {where}; close: the {family} singularity."),
        "bad": tr_later(
            "σ min is at least {least}, {share} of σ max, {where}; as good as singular: the {family} singularity."
        ),
    },
}


def _number(value: float) -> str:
    if value < 1e-12:
        return "0"
    if value >= 1e-3:
        return f"{value:.3g}"
    exponent = math.floor(math.log10(value))
    return f"{value / 10.0**exponent:.1f}·10{str(exponent).translate(_SUPERSCRIPT)}"


_SUPERSCRIPT = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")


def _table(report: Report, finding: Finding, units: Units) -> str:
    link = link_name(report.robot, finding.links[0])
    if finding.value < 0.0:
        return _capital(
            tr(
                "{link} is {depth} below it {where}.",
                link=link,
                depth=length_words(report.robot, -finding.value, units),
                where=where_words(finding),
            )
        )
    return tr(
        "At least {height} above it: {link}, {where}.",
        height=length_words(report.robot, finding.value, units),
        link=link,
        where=where_words(finding),
    )


def _own(report: Report, finding: Finding, units: Units) -> str:
    one, other = (link_name(report.robot, link) for link in finding.links)
    if finding.value < 0.0:
        return _capital(tr("{link} meets {other} {where}.", link=one, other=other, where=where_words(finding)))
    distance = length_words(report.robot, finding.value, units)
    return tr(
        "At least {distance} between {one} and {other}, {where}.",
        distance=distance,
        one=one,
        other=other,
        where=where_words(finding),
    )


def length_words(robot: Robot, length: float, units: Units) -> str:
    """A length [m] for a sentence, not finer than it helps."""
    value, unit = length_number(robot, length, units)
    return f"{value:.0f} {unit}" if unit == "mm" and value >= 10.0 else f"{left_to_right(f'{value:.3g}')} {unit}"


def _capital(sentence: str) -> str:
    return f"{sentence[0].upper()}{sentence[1:]}"
