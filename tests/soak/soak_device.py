"""Drive virtual arms for months: random lines, hands and faults. Nothing raises, and a stopped arm stays stopped.

    python tests/soak/soak_device.py [--minutes 10000] [--seed 0]

Prints simulated minutes, events and how much faster than real time it was; leaves with 1 at the first law that breaks,
naming the session's seed. tests/device/virtual/test_arm.py runs a slice of the same sessions.
"""

from __future__ import annotations

import argparse
import math
import random
import sys
import time
import traceback
from collections import Counter
from collections.abc import Callable

import numpy as np

from rvsim import load_robot
from rvsim.device.bridge.messages import (
    Clear,
    HostMessage,
    Identify,
    Limp,
    Period,
    Poll,
    PollAxes,
    SetPoints,
    Stop,
    Wake,
    encode,
)
from rvsim.device.virtual.arm import VirtualArm
from rvsim.device.virtual.bounds import settling_bound, settling_time
from rvsim.device.virtual.clock import FRAME
from rvsim.device.virtual.contract import Language
from rvsim.device.virtual.faults import Fault, Faults
from rvsim.robot.servos import joints_of, pulses_of

ROBOT = load_robot("al5b")
STILL_AFTER = settling_time(ROBOT)
SESSION = 60.0  # [min] then another arm, with another calibration
# Through these no STOP comes: whoever stops has to get rid of them first, as the driver's reconnection does.
DEAF = (Fault.PORT_VANISHES, Fault.WRONG_BAUD, Fault.SATURATED_BUFFER)
ODDITIES = (
    *(b"\r", b"\r\r\r", b"\r\n", b"  q\r", b"#\r", b"#5\r", b"#33P1500\r", b"#0P1510.0S100.0\r", b"#1p1500t0\r"),
    *(b"QP0QP1QP2\r", b"#0P15\x1b#1P1600T300\r", b"#2P1\xe2\x80\x8b500\r", b"VER\r", b"A BL C\r", b"VAVBVC\r", b"SS\r"),
    *(b"#0P100#1P2900\r", b"#3H#6L\r", b"#2:255\r", b"R4\r", b"R4=11520\r", b"RDFLT\r", b"#0PO50#1PO-50\r", b"T700\r"),
    *(b"SSCAT #0P1500;\r", b"SSDEL 255\r", b"R0=1\r", b"R0=0\r", b"\x00\xff" * 40, b"#0P1500" * 200 + b"\r"),
)

Event = Callable[[VirtualArm, random.Random], None]


def _group(arm: VirtualArm, dice: random.Random) -> None:
    """A group move of joints that stay near each other, as a program sends it."""
    q = [dice.uniform(lower, upper) for lower, upper in ROBOT.limits]
    pulses = np.clip(pulses_of(arm.servos, q), 500, 2500)
    chosen = dice.sample(range(ROBOT.dof), dice.randint(1, ROBOT.dof))
    line = "".join(f"#{arm.servos[i].channel}P{pulses[i]:.0f}{_speed(dice)}" for i in chosen)
    arm.write(f"{line}T{dice.randint(0, 6000)}\r".encode())


def _speed(dice: random.Random) -> str:
    return f"S{dice.randint(50, 3000)}" if dice.random() < 0.3 else ""


def _stream(arm: VirtualArm, dice: random.Random) -> None:
    """Set-points one after the other, and questions between them."""
    pulse = dice.randint(900, 2100)
    for step in range(dice.randint(1, 40)):
        arm.write(f"#0P{pulse + 5 * step}#1P{pulse - 3 * step}T60\rQ\rQP0QP1\r".encode())
        arm.process(dice.choice((0.02, 0.048, 0.0513)))
        arm.read()


def _grip(arm: VirtualArm, dice: random.Random) -> None:
    arm.write(f"#4P{dice.randint(500, 2500)}T{dice.randint(0, 2000)}\r".encode())


def _limp(arm: VirtualArm, dice: random.Random) -> None:
    arm.write(f"#{dice.choice(arm.servos).channel}P0\r".encode())


def _oddity(arm: VirtualArm, dice: random.Random) -> None:
    arm.write(dice.choice(ODDITIES))


def _noise(arm: VirtualArm, dice: random.Random) -> None:
    arm.write(dice.randbytes(dice.randint(1, 60)))


def _questions(arm: VirtualArm, dice: random.Random) -> None:
    """At 1 kHz."""
    for _ in range(dice.randint(1, 100)):
        arm.write(b"Q\r")
        arm.process(0.001)
        arm.read()


def _fault(arm: VirtualArm, dice: random.Random) -> None:
    on = frozenset(fault for fault in Fault if dice.random() < 0.15)
    count = ROBOT.dof + 1
    stalled, sagging = (dice.randrange(count),), (dice.randrange(count),)
    arm.faults = Faults(on, dice.randrange(1000), stalled, sagging)


def _no_faults(arm: VirtualArm, dice: random.Random) -> None:
    arm.faults = Faults()


def _hand(arm: VirtualArm, dice: random.Random) -> None:
    arm.put([dice.uniform(lower, upper) for lower, upper in ROBOT.limits])


def _power_cycle(arm: VirtualArm, dice: random.Random) -> None:
    arm.power_cycle()


def _stop(arm: VirtualArm, dice: random.Random) -> None:
    """STOP to the used channels: from then on no pulse changes, and the arm comes to rest where it must."""
    arm.faults = Faults(arm.faults.on.difference(DEAF), arm.faults.seed, arm.faults.stalled, arm.faults.sagging)
    if arm.dark:
        arm.process(0.5)
    if arm.language == "bridge":
        _say(arm, Stop(), Period(0))
        arm.process(FRAME)
    else:
        arm.write(b"\x1b" + b"".join(b"STOP%d\r" % channel for channel in range(32)))
    pulses, stopped = arm.commanded_pulses, arm.time
    while not arm.resting:
        arm.process(0.25)
        np.testing.assert_array_equal(arm.commanded_pulses, pulses, "a pulse changed after STOP")
        assert arm.time < stopped + STILL_AFTER, "the arm did not come to rest"
    assert_near_command(arm)


def assert_near_command(arm: VirtualArm) -> None:
    """Driven joints are as near to their pulses as the bound says, all within their end stops."""
    limits = np.array([servo.limits for servo in arm.servos]).T
    pulses = arm.commanded_pulses[[servo.channel for servo in arm.servos]]
    error = np.abs(arm.true_q - np.clip(joints_of(arm.servos, pulses), *limits))
    driven = np.isfinite(pulses)
    assert np.all(error[driven] <= settling_bound(ROBOT, arm.faults)[driven]), f"{np.degrees(error)}° away"
    assert np.all((arm.true_q >= limits[0]) & (arm.true_q <= limits[1])), "beyond an end stop"
    assert 0.0 <= arm.true_opening <= 1.0


def _say(arm: VirtualArm, *messages: HostMessage) -> None:
    """In frames of the bridge: whatever number was the last one, Identify begins anew."""
    arm.write(b"".join(encode(message, number) for number, message in enumerate((Identify(), *messages))))


def _set_points(arm: VirtualArm, dice: random.Random) -> None:
    """Woken or not, stopped or not."""
    if dice.random() < 0.5:
        _say(arm, Clear(), *(Wake(axis, 0 if axis == ROBOT.dof else None, 0) for axis in range(ROBOT.dof + 1)))
    places = [dice.choice((None, dice.randint(-18000, 18000))) for _ in range(ROBOT.dof + 1)]
    _say(arm, SetPoints(tuple(places), dice.randint(0, 6000)))


def _frames(arm: VirtualArm, dice: random.Random) -> None:
    """Single ones, some of which no board of ours obeys."""
    axis = dice.randrange(16)
    number = dice.choice((0, 20, 50, 1000))
    messages = (Poll(), PollAxes(), Stop(), Clear(), Limp(axis), Wake(axis, dice.randint(-9000, 9000), 500))
    arm.write(encode(dice.choice((*messages, Period(number), SetPoints((0, 0), 0))), dice.randrange(256)))


def _polls(arm: VirtualArm, dice: random.Random) -> None:
    """As fast as a frame goes over the wire, some of them spoilt."""
    for number in range(dice.randint(1, 100)):
        data = bytearray(encode(Poll(), number))
        data[dice.randrange(len(data))] ^= dice.choice((0, 0, 0, 1 << dice.randrange(8)))
        arm.write(bytes(data))
        arm.process(0.008)
        arm.read()


# How often, in a hundred, for each language.
BOTH: tuple[tuple[int, Event], ...] = (
    *((10, _stop), (6, _fault), (6, _no_faults), (5, _noise), (2, _hand), (1, _power_cycle)),
)
OFTEN: dict[Language, tuple[tuple[int, Event], ...]] = {
    "ssc32": (*BOTH, (40, _group), (12, _oddity), (6, _stream), (5, _grip), (4, _limp), (3, _questions)),
    "bridge": (*BOTH, (45, _set_points), (20, _frames), (5, _polls)),
}


def session(seed: int, minutes: float = SESSION, pause: float = 15.0) -> Counter[str]:
    """One arm for so many simulated minutes, something every `pause` seconds or so; what was done to it how often.

    Every fourth arm speaks the language of the bridge.
    """
    dice = random.Random(seed)
    language: Language = "bridge" if seed % 4 == 3 else "ssc32"
    arm = VirtualArm(ROBOT, seed=seed, language=language, potentiometers=bool(seed % 2))
    weights, events = zip(*OFTEN[language], strict=True)
    done: Counter[str] = Counter()
    while arm.time < 60.0 * minutes:
        (event,) = dice.choices(events, weights)
        event(arm, dice)
        arm.process(dice.choice((0.001, 1.0 / 60.0, 0.3, 2.0 * pause, dice.expovariate(1.0 / pause))))
        arm.read()
        done[event.__name__.strip("_")] += 1
        assert np.all(np.isfinite(arm.true_q)), "a joint is nowhere"
    return done


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--minutes", type=float, default=10_000.0)
    parser.add_argument("--seed", type=int, default=0)
    arguments = parser.parse_args()
    begin, done = time.perf_counter(), Counter[str]()
    count = math.ceil(arguments.minutes / SESSION)
    for seed in range(arguments.seed, arguments.seed + count):
        try:
            done += session(seed, min(SESSION, arguments.minutes))
        except Exception:
            traceback.print_exc()
            print(f"the session of seed {seed} broke a law")
            return 1
    elapsed = time.perf_counter() - begin
    minutes = count * min(SESSION, arguments.minutes)
    print(f"{minutes:.0f} simulated minutes, {done.total()} events, {elapsed:.0f} s")
    print(f"{60 * minutes / elapsed:.0f} × real time")
    print(", ".join(f"{number} {name.replace('_', ' ')}" for name, number in done.most_common()))
    return 0


if __name__ == "__main__":
    sys.exit(main())
