"""The worked solution is the closed form: every end is a branch, every line of arithmetic is true."""

import math
import re
from dataclasses import replace

import numpy as np
import pytest
from latex2mathml.converter import convert

from rvsim import language
from rvsim.files import load_robot, robot_names
from rvsim.kinematics import forward_kinematics
from rvsim.kinematics.inverse import branch_labels, inverse_branches, inverse_kinematics, inverse_kinematics_batch
from rvsim.lab.sentences import Units
from rvsim.lab.worked import worked_latex, worked_solution
from rvsim.lab.worked.figures import Figures
from rvsim.robot import Tool
from rvsim.spatial import rot_x, rot_z, transform

ARMS = sorted(robot_names())


def poses(robot, count, seed=0):
    """q (count, n), uniform within the limits; ±π, or 0 … 2, where there is none."""
    span = np.where(robot.is_revolute[:, None], [-np.pi, np.pi], [0.0, 2.0])
    lower, upper = np.where(np.isfinite(robot.limits), robot.limits, span).T
    return np.random.default_rng(seed).uniform(lower, upper, (count, robot.dof))


def apart(robot, a, b):
    difference = np.asarray(a) - np.asarray(b)
    turns = np.where(robot.is_revolute, 2.0 * np.pi * np.rint(difference / (2.0 * np.pi)), 0.0)
    return np.abs(difference - turns).max(axis=-1)


# --- the ends are the branches ---------------------------------------------------------------------------------------


@pytest.mark.parametrize("name", ARMS)
def test_the_ends_of_the_tree_are_the_branches_with_their_names(name):
    robot = load_robot(name)
    for q in poses(robot, 60):
        T = forward_kinematics(robot, q)
        solution = worked_solution(robot, T)
        columns = dict(zip(branch_labels(robot), inverse_kinematics_batch(robot, T[None])[0], strict=True))
        exist = {label: column for label, column in columns.items() if np.isfinite(column).all()}
        worked = {end.branch.label: end for end in solution.solutions}
        assert worked.keys() == exist.keys()
        for label, column in exist.items():
            assert apart(robot, worked[label].q, column) <= 1e-9, label
            if name != "rrrp":
                assert worked[label].label == label
        assert len(solution.solutions) == len(inverse_branches(robot, T))


@pytest.mark.parametrize("name", ARMS)
def test_each_end_has_the_verdict_of_its_branch(name):
    robot = load_robot(name)
    for q in poses(robot, 8, seed=2):
        T = forward_kinematics(robot, q)
        branches = inverse_kinematics(robot, T, near=q).branches
        for end in worked_solution(robot, T, q).solutions:
            same = min(branches, key=lambda branch: apart(robot, branch.q, end.q))
            assert end.within_limits == same.within_limits
            assert bool(end.reason) != end.within_limits


# --- arms that are not shipped ---------------------------------------------------------------------------------------


def with_tool(robot, xyz, R):
    return replace(robot, tools=(Tool("bent", "Bent", transform(R, np.array(xyz))),), tool_name="bent")


def edited(name, *changes):
    robot = load_robot(name)
    for joint, change in changes:
        robot = robot.with_joint(joint, **change)
    return robot


SQUARE = 0.5 * np.pi
EDITED = {
    "5R with a hand": load_robot("rv-m1").with_tool("standard hand"),
    "5R whose tip is beside its roll axis": with_tool(load_robot("rv-m1"), [0.01, 0.02, 0.1], rot_x(0.3)),
    "5R with a shoulder beside the base axis": edited("rv-m1", (0, {"a": 0.05})),
    "5R with other zeros": edited("rv-m1", (1, {"theta": 0.3}), (2, {"theta": -0.4})),
    "5R the other way round": edited("rv-m1", (0, {"alpha": -SQUARE}), (3, {"alpha": -SQUARE})),
    "5R with a half twist": edited("rv-m1", (1, {"alpha": np.pi})),
    "6R parallel with more lengths": edited("ur5e", (0, {"a": 0.05}), (3, {"a": 0.04})),
    "6R parallel the other way round": edited("ur5e", (0, {"alpha": -SQUARE}), (3, {"alpha": -SQUARE})),
    "6R parallel with tool and zeros": with_tool(edited("ur5e", (0, {"theta": 0.3})), [0.1, 0.05, 0.2], rot_x(0.4)),
    "6R spherical beside its axis": edited("rv-1a", (1, {"d": 0.07}), (0, {"a": 0.06})),
    "6R spherical the other way round": edited("rv-1a", (0, {"alpha": SQUARE}), (3, {"alpha": SQUARE})),
    "articulated with a bent tool": with_tool(edited("articulated", (1, {"d": 0.05})), [0.05, 0.03, 0.02], np.eye(3)),
    "spherical with a bent tool": with_tool(edited("spherical", (2, {"theta": 0.4})), [0.03, 0.02, 0.1], np.eye(3)),
    "SCARA with a bent tool": with_tool(edited("scara", (2, {"a": 0.05})), [0.05, 0.02, 0.1], rot_z(0.5)),
    "SCARA without a half twist": edited("scara", (1, {"alpha": 0.0})),
    "cylindrical beside its axis": edited("cylindrical", (1, {"a": 0.06})),
}


@pytest.mark.parametrize("robot", EDITED.values(), ids=EDITED.keys())
def test_the_ends_are_the_branches_of_arms_with_other_lengths_signs_and_tools_too(robot):
    for q in poses(robot, 12, seed=5):
        T = forward_kinematics(robot, q)
        columns = dict(zip(branch_labels(robot), inverse_kinematics_batch(robot, T[None])[0], strict=True))
        worked = {end.label: end.q for end in worked_solution(robot, T).solutions}
        assert worked.keys() == {label for label, column in columns.items() if np.isfinite(column).all()}
        for label, found in worked.items():
            assert apart(robot, found, columns[label]) <= 1e-9
            reached = forward_kinematics(robot, found)
            np.testing.assert_allclose(reached[:3, 3], T[:3, 3], atol=1e-9)


# --- the arithmetic is true ------------------------------------------------------------------------------------------

_ATAN2 = r"\operatorname{atan2}"


def evaluated(latex, turn=2.0 * math.pi):
    """The number a substituted formula stands for; angles in, angles out, `turn` is a whole one."""
    text = re.sub(r"\\frac\{(.*)\}\{([^{}]*)\}", r"((\1)/(\2))", latex)
    text = re.sub(r"\\sqrt\{(.*)\}", r"sqrt(\1)", text).replace(_ATAN2, "atan2").replace("\\,", "")
    text = re.sub(r"\\arcsin *(\(\(.*\))$", r"arcsin(\1)", text)
    text = re.sub(r"\\(cos|sin) *\(([^)]*)\)", r"\1(\2)", text)
    text = re.sub(r"\\(cos|sin) *([-0-9.]+)", r"\1(\2)", text)
    text = text.replace("^\\circ", "").replace("^", "**").replace("\\cdot", "*")
    unit = turn / (2.0 * math.pi)
    functions = {
        "atan2": lambda y, x: unit * math.atan2(y, x),
        "arcsin": lambda v: unit * math.asin(max(-1.0, min(1.0, v))),
        "sqrt": lambda v: math.sqrt(max(v, 0.0)),
        "cos": lambda v: math.cos(v / unit),
        "sin": lambda v: math.sin(v / unit),
    }
    return eval(text, {"__builtins__": {}}, functions)


def lines_of(robot, seed, units):
    for q in poses(robot, 12, seed):
        for step in worked_solution(robot, forward_kinematics(robot, q), units=units).steps:
            for equation in step.equations:
                if equation.substituted and equation.result and "bmatrix" not in equation.substituted:
                    yield equation


@pytest.mark.parametrize("units", [Units(), Units("rad", "m")], ids=["degrees", "radians"])
@pytest.mark.parametrize("name", ARMS)
def test_every_substituted_formula_gives_the_result_beside_it(name, units, monkeypatch):
    monkeypatch.setattr(Figures, "DECIMALS", dict.fromkeys(Figures.DECIMALS, 15))
    turn, sign = (360.0, "\\circ") if units.angle == "deg" else (2.0 * math.pi, "rad")
    count = 0
    for equation in lines_of(load_robot(name), 3, units):
        shown = re.split(r"\\equiv|\\,|\^", equation.result)[0]
        difference = evaluated(equation.substituted, turn) - float(shown)
        if sign in equation.result:
            difference = math.remainder(difference, turn)
        assert abs(difference) < 1e-7, equation
        count += 1
    assert count > 20 or name == "cartesian"


def test_in_radians_and_metres_nothing_is_left_of_degrees_and_millimetres():
    for name in ARMS:
        robot = load_robot(name)
        T = forward_kinematics(robot, robot.home + 0.1)
        for target in (T, at(0.9, 0.0, 0.9, T[:3, :3]), at(0.05, 0.0, 0.2, DOWN)):
            text = worked_latex(worked_solution(robot, target, units=Units("rad", "m")))
            assert "circ" not in text
            assert not re.search(r"\bmm\b", text)


# --- what cannot be had ----------------------------------------------------------------------------------------------


def failures(name, T):
    solution = worked_solution(load_robot(name), T)
    return solution, [step.failure for step in solution.steps if step.failure]


def at(x, y, z, R=None):
    T = np.eye(4)
    T[:3, :3], T[:3, 3] = np.eye(3) if R is None else R, (x, y, z)
    return T


DOWN = np.diag([1.0, -1.0, -1.0])


def test_out_of_reach_says_how_far_outside_the_ring():
    solution, said = failures("rv-m1", at(0.6, 0.0, 0.224, DOWN))
    assert not solution.solutions
    assert len(said) == 2
    away = (math.hypot(0.6, 0.144) - 0.41) * 1e3
    assert f"{away:.1f} mm outside the ring" in said[0]
    assert "cannot be above 1" in said[0]


def test_too_near_says_how_deep_in_the_hole():
    _, said = failures("planar", at(0.02, 0.0, 0.12))
    assert said == [
        "No solution: a cosine cannot be below −1. The point lies 30.0 mm inside the hole that the links leave, "
        "which has a radius of 50.0 mm."
    ]


def test_a_tool_axis_out_of_the_plane_is_said_with_its_angle():
    c, s = math.cos(0.2), math.sin(0.2)
    solution, said = failures("rv-m1", at(0.3, 0.0, 0.2, np.array([[1, 0, 0], [0, c, -s], [0, s, c]]) @ DOWN))
    assert said == [said[0]]
    assert "leans 11.46° out of the vertical plane" in said[0]
    assert [end.path for end in solution.branches] == [()]


def test_the_ur5e_says_how_near_the_wrist_is_to_its_axis():
    _, said = failures("ur5e", at(0.05, 0.0, 0.4, DOWN))
    assert said == [
        "No solution: the wrist (axis 5) is 50.0 mm from the base axis and must be at least 133.3 mm away. "
        "It lies 83.3 mm too near."
    ]


def test_a_tool_on_the_base_axis_of_an_arm_whose_plane_stands_beside_it_is_too_near():
    _, said = failures("ur5e", at(0.0, 0.0, 0.4, DOWN))
    assert said == [
        "No solution: the wrist (axis 5) is 0.0 mm from the base axis and must be at least 133.3 mm away. "
        "It lies 133.3 mm too near."
    ]


def test_the_other_side_of_the_rrrp_arm_is_a_dead_end_that_says_why():
    robot = load_robot("rrrp")
    solution = worked_solution(robot, forward_kinematics(robot, [0.3, 0.4, 0.5, 1.5]))
    dead = [end for end in solution.branches if end.q is None]
    assert len(solution.solutions) == len(dead) == 1
    assert "the tool axis passes" in dead[0].reason


# --- degenerate targets ----------------------------------------------------------------------------------------------

DEGENERATE = [
    ("rv-m1", (0, 99.829, -110, -20, 30), None),
    ("rv-m1", (20, 30, 0, 10, 30), "The elbow is straight"),
    ("al5b", (10, 60, 0, 10, 30), "The elbow is straight"),
    ("ur5e", (20, -70, 100, -50, 0, 35), "any q₆ will do"),
    ("ur5e", (20, -70, 0, -50, 60, 35), "The elbow is straight"),
    ("rv-1a", (20, 90, 10, 30, 0, 35), "any q₄ will do"),
]


@pytest.mark.parametrize(("name", "degrees", "said"), DEGENERATE)
def test_degenerate_steps_are_said_and_their_ends_reach_the_target(name, degrees, said):
    robot, q = load_robot(name), np.radians(degrees)
    T = forward_kinematics(robot, q)
    solution = worked_solution(robot, T, q)
    assert said is None or any(said in step.text for step in solution.steps)
    assert solution.solutions
    for end in solution.solutions:
        np.testing.assert_allclose(forward_kinematics(robot, end.q), T, atol=1e-9)
    assert min(apart(robot, end.branch.q, q) for end in solution.solutions) < 1e-5


def test_a_tool_on_the_base_axis_leaves_the_waist_free():
    T = at(0.0, 0.0, 0.152 + 0.3 + 0.072)
    solution = worked_solution(load_robot("rv-m1"), T, np.radians([25.0, 0.0, 0.0, 0.0, 0.0]))
    assert any("any q₁ will do" in step.text and "25.00°" in step.text for step in solution.steps)
    for end in solution.solutions:
        np.testing.assert_allclose(forward_kinematics(load_robot("rv-m1"), end.q), T, atol=1e-9)


def test_a_cylindrical_arm_on_its_axis_stays_where_it_is():
    robot, q = load_robot("cylindrical"), np.array([2.3, 0.2, 0.0])
    ends = worked_solution(robot, forward_kinematics(robot, q), q).solutions
    assert len(ends) == 2
    np.testing.assert_allclose(ends[0].q, q, atol=1e-12)


def test_a_spherical_arm_with_its_tool_at_the_shoulder_keeps_its_shoulder_angle():
    robot, q = load_robot("spherical"), np.array([0.4, 0.7, 0.0])
    solution = worked_solution(robot, forward_kinematics(robot, q), q)
    assert any("any q₂ will do" in step.text and "40.11°" in step.text for step in solution.steps)
    assert solution.solutions
    assert min(apart(robot, end.q, q) for end in solution.solutions) < 1e-9
    assert all(abs(end.q[1] - q[1]) < 1e-9 for end in solution.solutions)


# --- errata ----------------------------------------------------------------------------------------------------------

ERRATA = {
    "rv-m1": ((30, 40, -50, 20, 60), ("60.00°", "−205.2 mm", "352.8 mm", "60.00°, not −50.00°", "110.00°")),
    "rv-1a": ((10, 90, 10, 20, 60, 0), ("179.0 mm",)),
    "al5b": ((25, 60, -70, -35, 40), ("38.96°", "36.03°", "18.88°, not −70.00°", "d₅ sin ψ")),
}


@pytest.mark.parametrize("name", ERRATA)
def test_where_a_source_errs_the_step_shows_its_number_and_ours(name):
    degrees, shown = ERRATA[name]
    robot, q = load_robot(name), np.radians(degrees)
    solution = worked_solution(robot, forward_kinematics(robot, q), q)
    here = next(end for end in solution.solutions if apart(robot, end.q, q) < 1e-9)
    notes = " ".join(step.source_note for step in solution.along(here.path))
    for number in shown:
        assert number in notes


def test_source_003_is_wrong_at_the_start_of_its_own_path():
    robot = load_robot("rrrp")
    solution = worked_solution(robot, at(4.0, 3.0, 4.0))
    notes = " ".join(step.source_note for step in solution.along(solution.solutions[0].path))
    assert "36.87°" in notes
    assert "−90.00°" in notes
    assert "−178.43°" in notes


# --- LaTeX -----------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("name", ARMS)
def test_the_latex_is_a_whole_document_in_ascii_with_balanced_braces(name):
    robot = load_robot(name)
    text = worked_latex(worked_solution(robot, forward_kinematics(robot, robot.home)))
    assert text.isascii()
    assert text.startswith("\\documentclass")
    assert text.rstrip().endswith("\\end{document}")
    depth = 0
    for sign in re.sub(r"\\[{}]", "", text):
        depth += {"{": 1, "}": -1}.get(sign, 0)
        assert depth >= 0
    assert depth == 0
    begun, ended = (re.findall(rf"\\{word}{{(\w+\*?)}}", text) for word in ("begin", "end"))
    assert sorted(begun) == sorted(ended)


class Marked(dict):
    """A catalogue that has other words for every text."""

    def get(self, text, default=None):
        return (f"«{text}»",)


@pytest.mark.parametrize("name", ARMS)
@pytest.mark.parametrize("scale", [1.0, 1.3, 0.2, 0.0])
def test_the_latex_is_the_same_in_any_language(name, scale, monkeypatch):
    robot = load_robot(name)
    T = forward_kinematics(robot, robot.home)
    T[:3, 3] *= scale
    english = worked_latex(worked_solution(robot, T))
    monkeypatch.setattr(language, "_spoken", (language.LANGUAGES["ar"], language.Catalogue(Marked(), lambda _: 0)))
    said = worked_solution(robot, T)
    assert "«" in said.steps[0].text
    assert worked_latex(said) == english


_ARGUMENT = r"(?:\{(?:[^{}]|\{[^{}]*\})*\}|\\[a-zA-Z]+|\w)"
_TWICE = re.compile(rf"\^{_ARGUMENT}\s*\^|_{_ARGUMENT}\s*_")  # LaTeX: double superscript, double subscript


@pytest.mark.parametrize("name", ARMS)
def test_every_line_of_the_latex_can_be_typeset(name):
    robot = load_robot(name)
    text = worked_latex(worked_solution(robot, forward_kinematics(robot, robot.home + 0.1)))
    blocks = re.findall(r"\\begin\{align\*\}\n(.*?)\n\\end\{align\*\}", text, re.DOTALL)
    assert blocks
    for line in " \\\\\n".join(blocks).split(" \\\\\n"):
        assert "<mi>\\" not in convert(line.replace("&=", "=", 1)), line  # an unknown command
        assert not _TWICE.search(line), line
        assert re.sub(r"\\begin\{(\w+)\}.*?\\end\{\1\}", "", line).count("&") == 1, line


def test_a_name_of_the_users_own_breaks_no_latex():
    robot = replace(load_robot("planar"), title="50 % \\ {R&D} #1_$^~")
    text = worked_latex(worked_solution(robot, forward_kinematics(robot, robot.home)))
    assert "50 \\% \\textbackslash{} \\{R\\&D\\} \\#1\\_\\$\\textasciicircum{}\\textasciitilde{}" in text


def test_latex_of_one_way_has_only_its_steps():
    robot = load_robot("rv-m1")
    solution = worked_solution(robot, forward_kinematics(robot, robot.home + 0.1))
    path = solution.solutions[0].path
    assert worked_latex(solution, path).count("\\subsection") == len(solution.along(path)) + 1


@pytest.mark.parametrize("name", ["rv-1a", "ur5e", "rrrp", "al5b"])
def test_no_zero_has_a_sign(name):
    robot = load_robot(name)
    for q in (robot.home, np.zeros(robot.dof)):
        text = worked_latex(worked_solution(robot, forward_kinematics(robot, q)))
        assert not re.search(r"[(,{=] *-0\.0+(?![\d.])|\\,-0\.0+(?![\d.])", text)
