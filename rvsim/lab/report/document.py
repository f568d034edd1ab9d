"""The report of a study: which parts it has, and the document that they make."""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping
from typing import NamedTuple

import numpy as np

from rvsim.lab.report.figures import Measures, number_word, scientific, within_limits_words
from rvsim.lab.report.path_words import path_title
from rvsim.lab.report.section_end import end_section
from rvsim.lab.report.section_inverse import inverse_section
from rvsim.lab.report.section_jacobian import jacobian_section
from rvsim.lab.report.section_measured import measured_section
from rvsim.lab.report.section_motion import between_words, motion_section
from rvsim.lab.report.section_path import path_section
from rvsim.lab.report.section_pose import pose_section
from rvsim.lab.report.section_robot import robot_section
from rvsim.lab.report.section_sources import sources_section
from rvsim.lab.report.section_torques import torques_section
from rvsim.lab.report.study import Study
from rvsim.lab.report.values import Cover, Document, Paragraph, Section, numbered
from rvsim.lab.sources import errata
from rvsim.language import left_to_right, tr, tr_later, trn, without_isolates


class Part(NamedTuple):
    """A part that may be left out: its name, what it is called, and whether a study has it."""

    name: str
    title: str
    there: Callable[[Study], bool]


def _always(_study: Study) -> bool:
    return True


PARTS: tuple[Part, ...] = (
    Part("robot", tr_later("The robot: DH table and limits"), _always),
    Part("pose", tr_later("Forward kinematics with all matrices"), _always),
    Part("inverse", tr_later("Inverse kinematics: all branches"), _always),
    Part("steps", tr_later("Inverse kinematics, step by step"), lambda study: study.inverse is not None),
    Part("jacobian", tr_later("Jacobian and singularities"), _always),
    Part("torques", tr_later("Forces and torques"), _always),
    Part("path", tr_later("The path and its check"), lambda study: study.tracking is not None),
    Part("motion", tr_later("Curves over time"), lambda study: study.trajectory is not None),
    Part(
        "measured",
        tr_later("On the arm: sent, measured or reported"),
        lambda study: study.recording is not None and not study.recording.empty,
    ),
    Part("sources", tr_later("Errata of the sources"), lambda study: bool(errata(study.robot))),
)


def parts_of(study: Study) -> tuple[str, ...]:
    """The names of the parts that a study has."""
    return tuple(part.name for part in PARTS if part.there(study))


def build(
    study: Study, cover: Cover, parts: Collection[str] | None = None, files: Mapping[str, str] | None = None
) -> Document:
    """The document, its captions numbered.

    Args:
        cover: its date too: nothing here reads a clock.
        parts: names of `PARTS`, None for all; what the study has not is left out.
        files: the names of the files beside the report, and what is in each.
    """
    measures = Measures(study.robot, study.units)
    wanted = set(parts_of(study)) & set(parts_of(study) if parts is None else parts)
    makers: dict[str, Callable[[], Section]] = {
        "robot": lambda: robot_section(study, measures),
        "pose": lambda: pose_section(study, measures),
        "inverse": lambda: inverse_section(study, measures, steps="steps" in wanted),
        "jacobian": lambda: jacobian_section(study, measures),
        "torques": lambda: torques_section(study),
        "path": lambda: path_section(study, measures),
        "motion": lambda: motion_section(study, measures),
        "measured": lambda: measured_section(study, measures),
        "sources": lambda: sources_section(study, measures),
    }
    sections = [make() for name, make in makers.items() if name in wanted]
    everything = (_summary(study, measures), *sections, end_section(study, files or {}))
    return numbered(Document(cover, tr(study.robot.title), everything))


def _summary(study: Study, measures: Measures) -> Section:
    place = ",\u00a0".join(measures.length.text(float(value)) for value in study.T[:3, 3])
    joints = ", ".join(measures.joint(i).amount(float(value)) for i, value in enumerate(study.q))
    sentences = [
        tr("The {title} stands at q = ({joints}).", title=tr(study.robot.title), joints=joints),
        tr("Its tool is then at x,\u00a0y,\u00a0z\u00a0= ({place}) {unit}.", place=place, unit=measures.length.unit),
        *_inverse_words(study),
        *_path_words(study, measures),
        *_measured_words(study, measures),
    ]
    return Section(tr("Summary"), (Paragraph(" ".join(sentences), "lead"),))


def _inverse_words(study: Study) -> list[str]:
    if study.inverse is None:
        return []
    count, within = len(study.inverse.branches), sum(branch.within_limits for branch in study.inverse.branches)
    leading = trn(
        "For the arm’s task {count} joint pose leads there.",
        "For the arm’s task {count} joint poses lead there.",
        count,
        count=number_word(count),
    )
    return [leading, within_limits_words(within, count)] if count else [leading]


def _path_words(study: Study, measures: Measures) -> list[str]:
    tracking = study.tracking
    if tracking is None:
        return []
    title = tr(tracking.path.title or tracking.path.name)
    if tracking.rms is None:
        return [tr("Of the path “{title}” no point can be reached.", title=title)]
    rms = left_to_right(f"{scientific(tracking.rms * measures.length.factor)} {measures.length.unit}")
    values: dict[str, object] = {
        "title": title,
        "percent": left_to_right(f"{100.0 * tracking.reached_count / tracking.samples:.0f} %"),
        "count": tracking.samples,
        "rms": rms,
    }
    between = between_words(study.curves, measures) if tracking.complete else ""
    if not between:
        return [
            tr(
                "On the path “{title}” it reaches {percent} of the {count} points; there the deviation is {rms} (RMS).",
                **values,
            )
        ]
    return [
        tr(
            "On the path “{title}” it reaches {percent} of the {count} points; there the deviation is {rms} (RMS), "
            "and between them, where the joints follow a spline, at most {between}.",
            **values,
            between=between,
        )
    ]


def _measured_words(study: Study, measures: Measures) -> list[str]:
    if study.recording is None or study.recording.empty:
        return []
    part = study.recording.on_trajectory()
    rms = float(part.tool_errors(study.robot).rms)
    if np.isnan(rms):
        return []
    amount = measures.length.amount(rms)
    if part.is_measured:
        return [
            tr("When the motion ran on an arm, the tool was {amount} (RMS) from where it was to be.", amount=amount)
        ]
    return [
        tr(
            "When the motion ran on an arm, the controller reported pulses that stand for a tool {amount} (RMS) from "
            "where it was to be; that is no measurement.",
            amount=amount,
        )
    ]


def title_of(study: Study) -> str:
    """A title to begin with: the arm and what was done with it."""
    robot, ran = tr(study.robot.title), study.recording is not None and not study.recording.empty
    if study.tracking is not None:
        title = path_title(study, study.tracking.path, ran=ran)
    elif ran:
        title = tr("{robot}: a pose, and a motion run on the arm", robot=robot)
    else:
        title = tr("{robot}: the kinematics of a pose", robot=robot)
    return without_isolates(title)
