"""Newton–Euler against the oracle, against energy, and against itself."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rvsim import load_robot
from rvsim.dynamics import (
    coriolis_torques,
    dynamics_parts,
    forward_dynamics,
    gravity_torques,
    inertia_torques,
    inverse_dynamics,
    joint_torques,
    kinetic_energy,
    mass_matrix,
    payload_wrench,
    potential_energy,
)
from rvsim.errors import NoMassDataError, RobotDefinitionError, ShapeError
from rvsim.robot import Joint, LinkMass, Robot, Tool
from rvsim.spatial import transform_from_twist

lengths = st.floats(-1.0, 1.0)
placements = st.lists(lengths, min_size=6, max_size=6).map(transform_from_twist)


def positive_inertia(values: list[float]) -> np.ndarray:
    half = np.reshape(values, (3, 3))
    return half @ half.T + 0.05 * np.eye(3)


inertias = st.one_of(st.lists(lengths, min_size=9, max_size=9).map(positive_inertia), st.just(np.diag([0.2, 0.2, 0.3])))
rows = st.tuples(
    st.builds(
        Joint, st.just("j"), st.sampled_from(["revolute", "prismatic"]), lengths, lengths, lengths, st.floats(-3.2, 3.2)
    ),
    st.builds(LinkMass, st.floats(0.1, 3.0), st.lists(lengths, min_size=3, max_size=3), inertias),
)
arms = st.builds(
    lambda rows, convention, base, tool: Robot(
        "any", "Any", convention, tuple(joint for joint, _ in rows), base, (Tool("t", "T", tool),),
        masses=tuple(link for _, link in rows),
    ),
    st.lists(rows, min_size=1, max_size=5), st.sampled_from(["standard", "modified"]), placements, placements,
)  # fmt: skip
payloads = st.sampled_from([0.0, 0.7])


def random(robot: Robot, *shape: int, count: int = 1) -> list[np.ndarray]:
    generator = np.random.default_rng(7)
    return [generator.uniform(-2.0, 2.0, (*shape, robot.dof)) for _ in range(count)]


@pytest.fixture(scope="module")
def ur5e() -> Robot:
    return load_robot("ur5e")


def test_torques_gravity_and_mass_matrix_are_the_oracles(ur5e, oracle):
    cases = oracle["ur5e_dynamics"]["cases"]
    q, qd, qdd, tau, holding, M = (
        np.array([case[key] for case in cases]) for key in ("q", "qd", "qdd", "tau", "tau_gravity", "M")
    )
    np.testing.assert_allclose(inverse_dynamics(ur5e, q, qd, qdd), tau, rtol=0.0, atol=1e-9)
    np.testing.assert_allclose(gravity_torques(ur5e, q), holding, rtol=0.0, atol=1e-9)
    np.testing.assert_allclose(mass_matrix(ur5e, q), M, rtol=0.0, atol=1e-9)
    for case in cases[:3]:
        one = inverse_dynamics(ur5e, case["q"], case["qd"], case["qdd"])
        np.testing.assert_allclose(one, case["tau"], rtol=0.0, atol=1e-9)


def test_the_source_s_holding_torques_at_zero(ur5e):
    np.testing.assert_allclose(gravity_torques(ur5e, np.zeros(6)), [0, -59.736, -18.433, 0, 0, 0], atol=5e-4)


@given(arms, payloads)
def test_gravity_is_the_slope_of_the_potential_energy(robot, payload):
    (q,) = random(robot, 3)
    step = 1e-5
    for joint in range(robot.dof):
        shift = step * np.eye(robot.dof)[joint]
        up, down = (potential_energy(robot, q + sign * shift, payload=payload) for sign in (1, -1))
        slope = (up - down) / (2 * step)
        np.testing.assert_allclose(gravity_torques(robot, q, payload=payload)[:, joint], slope, atol=1e-6)


@given(arms, payloads)
def test_the_torques_power_is_the_growth_of_energy(robot, payload):
    q, qd, qdd = random(robot, 3, count=3)
    step = 1e-5

    def energy(t: float) -> np.ndarray:
        there, rate = q + t * qd + t * t / 2 * qdd, qd + t * qdd
        return kinetic_energy(robot, there, rate, payload=payload) + potential_energy(robot, there, payload=payload)

    growth = (energy(step) - energy(-step)) / (2 * step)
    tau = inverse_dynamics(robot, q, qd, qdd, payload=payload)
    np.testing.assert_allclose(np.sum(tau * qd, axis=-1), growth, rtol=1e-6, atol=1e-5)


@given(arms, payloads)
def test_the_mass_matrix_is_symmetric_positive_and_inertia_is_its_product(robot, payload):
    q, qdd = random(robot, 3, count=2)
    M = mass_matrix(robot, q, payload=payload)
    np.testing.assert_array_equal(M, np.swapaxes(M, -1, -2))
    assert np.linalg.eigvalsh(M).min() > 0.0
    product = (M @ qdd[..., None])[..., 0]
    np.testing.assert_allclose(inertia_torques(robot, q, qdd, payload=payload), product, atol=1e-9)


@given(arms)
def test_the_parts_sum_to_the_whole_and_forward_dynamics_undoes_it(robot):
    q, qd, qdd = random(robot, 4, count=3)
    whole = inverse_dynamics(robot, q, qd, qdd, payload=0.4)
    np.testing.assert_allclose(dynamics_parts(robot, q, qd, qdd, payload=0.4).total, whole, atol=1e-9)
    np.testing.assert_allclose(forward_dynamics(robot, q, qd, whole, payload=0.4), qdd, atol=1e-6)


def test_coriolis_is_quadratic_in_the_rates_and_does_no_work_beyond_the_mass_matrix_change(ur5e):
    q, qd = random(ur5e, 5, count=2)
    np.testing.assert_allclose(coriolis_torques(ur5e, q, 3 * qd), 9 * coriolis_torques(ur5e, q, qd), atol=1e-9)
    step = 1e-6
    M_dot = (mass_matrix(ur5e, q + step * qd) - mass_matrix(ur5e, q - step * qd)) / (2 * step)
    skew_power = np.sum(qd * coriolis_torques(ur5e, q, qd), -1) - 0.5 * np.einsum("mi,mij,mj->m", qd, M_dot, qd)
    np.testing.assert_allclose(skew_power, 0.0, atol=1e-6)


def as_modified(robot: Robot) -> Robot:
    """The same standard-DH arm in Craig's form: a and alpha go to the next row, the last ones into the tool."""
    previous = (0.0, 0.0)
    joints, masses = [], []
    for joint, link in zip(robot.joints, robot.masses, strict=True):
        joints.append(replace(joint, a=previous[0], alpha=previous[1]))
        previous = joint.a, joint.alpha
        step = np.eye(4)  # from the modified frame of the link to the standard one: Tx(a) Rx(alpha)
        cosine, sine = np.cos(joint.alpha), np.sin(joint.alpha)
        step[:3, :3], step[0, 3] = [[1, 0, 0], [0, cosine, -sine], [0, sine, cosine]], joint.a
        com, R = step[:3, :3] @ link.com + step[:3, 3], step[:3, :3]
        masses.append(replace(link, com=com, inertia=R @ link.inertia @ R.T))
    tool = Tool("t", "T", step @ robot.T_flange_tool)
    return replace(
        robot, convention="modified", joints=tuple(joints), masses=tuple(masses), tools=(tool,), tool_name="t"
    )


def test_an_arm_written_in_either_convention_has_the_same_dynamics(ur5e):
    other = as_modified(ur5e)
    q, qd, qdd = random(ur5e, 10, count=3)
    for payload in (0.0, 2.0):
        expected = inverse_dynamics(ur5e, q, qd, qdd, payload=payload)
        np.testing.assert_allclose(inverse_dynamics(other, q, qd, qdd, payload=payload), expected, atol=1e-9)
    np.testing.assert_allclose(mass_matrix(other, q), mass_matrix(ur5e, q), atol=1e-12)


def test_a_two_link_arm_obeys_the_textbook_s_formulas():
    # Siciliano et al., eq. (7.82) with point masses at the ends of the links, in a vertical plane.
    m1, m2, a1, a2, g = 1.5, 0.8, 0.4, 0.3, 9.81
    upright = np.array([[1.0, 0, 0, 0], [0, 0, -1, 0], [0, 1, 0, 0], [0, 0, 0, 1]])
    joints = tuple(Joint(f"j{i}", "revolute", 0.0, 0.0, a, 0.0) for i, a in enumerate((a1, a2)))
    masses = tuple(LinkMass(m, np.zeros(3), np.zeros((3, 3))) for m in (m1, m2))
    robot = Robot("2r", "2R", "standard", joints, upright, masses=masses)
    (q1, q2), (v1, v2), (w1, w2) = q, qd, qdd = (0.3, 0.7), (1.1, -0.4), (0.5, 2.0)
    c2, s2 = np.cos(q2), np.sin(q2)
    M11 = (m1 + m2) * a1**2 + m2 * a2**2 + 2 * m2 * a1 * a2 * c2
    M12, M22, h = m2 * a2**2 + m2 * a1 * a2 * c2, m2 * a2**2, -m2 * a1 * a2 * s2
    G2 = m2 * g * a2 * np.cos(q1 + q2)
    G1 = (m1 + m2) * g * a1 * np.cos(q1) + G2
    tau = [M11 * w1 + M12 * w2 + 2 * h * v1 * v2 + h * v2**2 + G1, M12 * w1 + M22 * w2 - h * v1**2 + G2]
    np.testing.assert_allclose(inverse_dynamics(robot, q, qd, qdd, gravity=g), tau, atol=1e-12)


def test_a_payload_is_carried_like_a_wrench_and_a_wrench_adds_its_own(ur5e):
    q, qd, qdd = random(ur5e, 6, count=3)
    carried = gravity_torques(ur5e, q) + joint_torques(ur5e, q, payload_wrench(3.0, 9.80665))
    np.testing.assert_allclose(gravity_torques(ur5e, q, payload=3.0), carried, atol=1e-9)
    F = np.array([1.0, -2.0, 3.0, 0.4, 0.5, -0.6])
    difference = inverse_dynamics(ur5e, q, qd, qdd, wrench=F) - inverse_dynamics(ur5e, q, qd, qdd)
    np.testing.assert_allclose(difference, joint_torques(ur5e, q, F), atol=1e-9)


def test_leading_shapes_broadcast(ur5e):
    q, qd = random(ur5e, 4, 1, count=2)
    qdd = random(ur5e, 30)[0]
    tau = inverse_dynamics(ur5e, q, qd, qdd, gravity=np.full((4, 1), 9.80665))
    assert tau.shape == (4, 30, 6)
    np.testing.assert_allclose(tau[2, 5], inverse_dynamics(ur5e, q[2, 0], qd[2, 0], qdd[5]), atol=1e-9)
    assert gravity_torques(ur5e, np.zeros((0, 6))).shape == (0, 6)
    assert np.shape(kinetic_energy(ur5e, q, qd)) == (4, 1)


def test_an_arm_without_masses_says_so_and_a_wrong_shape_is_named(ur5e):
    bare = replace(ur5e, masses=())
    for ask in (gravity_torques, mass_matrix, potential_energy):
        with pytest.raises(NoMassDataError, match="ur5e has no mass data: add a mass"):
            ask(bare, np.zeros(6))
    with pytest.raises(NoMassDataError):
        inverse_dynamics(bare, *np.zeros((3, 6)))
    with pytest.raises(ShapeError, match=r"qdd must have the shape \(\.\.\., 6\)"):
        inverse_dynamics(ur5e, np.zeros(6), np.zeros(6), np.zeros(5))


def test_a_joint_that_moves_nothing_has_no_acceleration(ur5e):
    masses = (*ur5e.masses[:5], replace(ur5e.masses[5], inertia=np.zeros((3, 3))))
    with pytest.raises(RobotDefinitionError, match="inertia"):
        forward_dynamics(replace(ur5e, masses=masses), *np.zeros((3, 6)))
