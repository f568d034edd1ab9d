"""What it takes: torques that hold a force, torques that hold and move the arm itself, and its energies."""

from rvsim.dynamics.energy import kinetic_energy, potential_energy
from rvsim.dynamics.inertia import forward_dynamics, mass_matrix
from rvsim.dynamics.newton_euler import (
    STANDARD_GRAVITY,
    DynamicsParts,
    coriolis_torques,
    dynamics_parts,
    gravity_torques,
    inertia_torques,
    inverse_dynamics,
)
from rvsim.dynamics.statics import LargestForce, joint_torques, largest_force, payload_wrench, wrench_in_base

__all__ = [
    "STANDARD_GRAVITY",
    "DynamicsParts",
    "LargestForce",
    "coriolis_torques",
    "dynamics_parts",
    "forward_dynamics",
    "gravity_torques",
    "inertia_torques",
    "inverse_dynamics",
    "joint_torques",
    "kinetic_energy",
    "largest_force",
    "mass_matrix",
    "payload_wrench",
    "potential_energy",
    "wrench_in_base",
]
