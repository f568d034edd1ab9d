"""What the check of a path found, as sentences: a symbol and a word for how grave it is, then what, where and why."""

from __future__ import annotations

import math

from rvsim.lab.sentences import Units, joint_amount, length_number, stretch_reason
from rvsim.language import tr, tr_later
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
    return (
        tr("Not as it is: one thing is wrong.")
        if worst == 1
        else tr("Not as it is: {worst} things are wrong.", worst=worst)
    )


def where_words(finding: Finding) -> str:
    """Which points: "point 7", "points 7–9", "on the way to the path"."""
    if finding.index is None:
        return tr("on the way to the path")
    last = finding.index if finding.last is None else finding.last
    if last == finding.index:
        return tr("at point {last}", last=last + 1)
    return tr("points {index}\u2013{last}", index=finding.index + 1, last=last + 1)


def link_name(robot: Robot, link: int) -> str:
    """ "the base", "link 3 (behind the elbow)"."""
    if link == 0:
        return tr("the base")
    name = robot.joint_names[link - 1]
    return tr(
        "link {link} (behind {value}{name})",
        link=link,
        value="the " if name.replace(" ", "").isalpha() else "",
        name=name,
    )


def _reach(report: Report, finding: Finding, _units: Units) -> str:
    tracking = report.tracking
    count = tr(
        "{reached_count} of {samples} points reached", reached_count=tracking.reached_count, samples=tracking.samples
    )
    return f"{'All' if tracking.complete else f'{100.0 * finding.value:.0f} %'}: {count}."


def _missed(report: Report, finding: Finding, units: Units) -> str:
    where = where_words(finding).removeprefix("at ")
    return f"{where[0].upper()}{where[1:]}: {stretch_reason(report.robot, list(finding.points), units)}."


def _jump(_report: Report, finding: Finding, _units: Units) -> str:
    assert finding.index is not None
    lifted = tr(" with the pen lifted") if finding.severity == "good" else tr("; the tool leaves the path there")
    return tr(
        "From point {index} to {index2} the arm changes its branch{lifted}.",
        index=finding.index + 1,
        index2=finding.index + 2,
        lifted=lifted,
    )


def _rate(report: Report, finding: Finding, units: Units) -> str:
    assert finding.joint is not None
    joint = f"{report.robot.joint_names[finding.joint]} {where_words(finding)}"
    value, limit = (_rate_text(report.robot, finding, value, units) for value in (finding.value, finding.limit))
    source = "assumed " if finding.assumed else ""
    share = 100.0 * finding.value / finding.limit
    return tr(
        "At most {share:.0f} %: {joint}, {value} of the {source}{limit}.",
        share=share,
        joint=joint,
        value=value,
        source=source,
        limit=limit,
    )


def _pace(report: Report, finding: Finding, _units: Units) -> str:
    assert finding.joint is not None
    joint = f"{report.robot.joint_names[finding.joint]} {where_words(finding)}"
    times = tr("{value:.2f} s instead of the {limit:.2f} s asked for", value=finding.value, limit=finding.limit)
    if finding.severity == "good":
        return tr("Slowed down where a joint needs it, most of all {joint}: {times}.", joint=joint, times=times)
    return tr(
        "{capital} cannot go so fast, so all of it is slowed down: {times}.", capital=_capital(joint), times=times
    )


def _rate_text(robot: Robot, finding: Finding, value: float, units: Units) -> str:
    assert finding.joint is not None
    text = joint_amount(robot, robot.joint_names[finding.joint], value, units)
    return f"{text}{_RATES[finding.kind]}"


def _singular(_report: Report, finding: Finding, _units: Units) -> str:
    numbers = tr(
        "σ min is at least {number}, {number2} of σ max, {where}",
        number=_number(finding.value),
        number2=_number(finding.limit),
        where=where_words(finding),
    )
    family = tr(": the {family} singularity", family=finding.family) if finding.family else ""
    close = {"good": "", "warning": "; close", "bad": tr("; as good as singular")}[finding.severity]
    return f"{numbers}{close}{family}."


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
        return tr(
            "{capital} is {length} below it {where}.",
            capital=_capital(link),
            length=length_words(report.robot, -finding.value, units),
            where=where_words(finding),
        )
    return tr(
        "At least {length} above it: {link}, {where}.",
        length=length_words(report.robot, finding.value, units),
        link=link,
        where=where_words(finding),
    )


def _own(report: Report, finding: Finding, units: Units) -> str:
    one, other = (link_name(report.robot, link) for link in finding.links)
    if finding.value < 0.0:
        return tr("{capital} meets {other} {where}.", capital=_capital(one), other=other, where=where_words(finding))
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
    return f"{value:.0f} {unit}" if unit == "mm" and value >= 10.0 else f"{value:.3g} {unit}"


def _capital(text: str) -> str:
    return f"{text[0].upper()}{text[1:]}"
