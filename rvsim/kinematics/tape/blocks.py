"""A program on rows of numpy arrays, a block of poses at a time.

Measured on two cores with numpy 2.4: sine and cosine cost 8 ns each, the tangent 1, so both come from one tan(angle/2).
Blocks of a few thousand poses keep all rows in the cache while the cost of calling numpy fades.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from rvsim.kinematics.tape.program import Angle, Program, is_constant
from rvsim.spatial.arrays import FloatArray

_BLOCK = 4096
_UFUNCS = {"+": np.add, "-": np.subtract, "*": np.multiply}


class BlockPlan(NamedTuple):
    """A program with a place for every name: operands are first the constants, then the rows of a workspace."""

    angles: tuple[Angle, ...]
    joints: tuple[int, ...]  # the joint variables that are used as they are, in the rows after sines and cosines
    constants: tuple[FloatArray, ...]
    steps: tuple[tuple[np.ufunc, int, int, int], ...]
    outputs: tuple[tuple[int, int, bool], ...]  # column, operand, negative
    rows: int

    def play(self, q: FloatArray, results: FloatArray) -> None:
        """Fill results (m, k), which are zeros, for q (m, n)."""
        block = min(len(q), _BLOCK)
        workspace = np.empty((self.rows, block))
        # The tangent of infinity is nan, the sum of huge lengths infinite: those are the answers.
        with np.errstate(invalid="ignore", over="ignore"):
            for start in range(0, len(q), block):
                part = q[start : start + block]
                self._play_block(part, workspace[:, : len(part)], results[start : start + block])

    def _play_block(self, q: FloatArray, rows: FloatArray, results: FloatArray) -> None:
        self._fill_inputs(q, rows)
        operands = [*self.constants, *rows]
        for operation, left, right, target in self.steps:
            operation(operands[left], operands[right], operands[target])
        for column, operand, negative in self.outputs:
            if negative:
                np.negative(operands[operand], results[:, column])
            else:
                results[:, column] = operands[operand]

    def _fill_inputs(self, q: FloatArray, rows: FloatArray) -> None:
        """Sines and cosines from t = tan(angle/2): cos = 2/(1 + t²) − 1, sin = t (cos + 1); π itself gives t = 2e16."""
        count = len(self.angles)
        sine, cosine = rows[:count], rows[count : 2 * count]
        for row, (_, joints, constant) in zip(sine, self.angles, strict=True):
            np.add(q[:, joints[0]], constant, out=row)
            for joint in joints[1:]:
                row += q[:, joint]
        sine *= 0.5
        np.tan(sine, out=sine)
        np.multiply(sine, sine, out=cosine)
        cosine += 1.0
        np.divide(2.0, cosine, out=cosine)
        sine *= cosine
        cosine -= 1.0
        for row, joint in enumerate(self.joints, start=2 * count):
            rows[row] = q[:, joint]


def block_plan(program: Program) -> BlockPlan:
    """The plan of a program."""
    names = [name for step in program.steps for name in (step.left, step.right)]
    names += [output.name for output in program.outputs]
    constants = sorted({name for name in names if is_constant(name)})
    joints = sorted({int(name[1:]) for name in names if name[0] == "q"})
    inputs = [f"{letter}{angle.number}" for letter in "sc" for angle in program.angles]
    inputs += [f"q{joint}" for joint in joints]
    places, total = _places(program, [*constants, *inputs])
    return BlockPlan(
        angles=program.angles,
        joints=tuple(joints),
        constants=tuple(np.array(float(name)) for name in constants),
        steps=tuple((_UFUNCS[s.operation], places[s.left], places[s.right], places[s.name]) for s in program.steps),
        outputs=tuple((i, places[o.name], o.negative) for i, o in enumerate(program.outputs) if o.name != "0.0"),
        rows=total - len(constants),
    )


def _places(program: Program, inputs: list[str]) -> tuple[dict[str, int], int]:
    """A place for every name, and how many there are; a step takes over the place of a value used for the last time."""
    last_use = {name: i for i, step in enumerate(program.steps) for name in (step.left, step.right)}
    last_use |= {output.name: len(program.steps) for output in program.outputs}
    places, free, total = {name: i for i, name in enumerate(inputs)}, list[int](), len(inputs)
    for i, step in enumerate(program.steps):
        for name in dict.fromkeys((step.left, step.right)):
            if last_use[name] == i and not is_constant(name):
                free.append(places[name])
        if not free:
            free, total = [total], total + 1
        places[step.name] = free.pop()
    return places, total
