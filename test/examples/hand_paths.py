# SPDX-License-Identifier: GPL-3.0-or-later
"""Paths of a hand for `haptic_loop --path`, drawn at random."""
import math

RADIUS = 0.030  # m: the scene is fitted into a ball of 34 mm about the handle's home
BUTTONS_OF_A_HAND = (0, 0, 1, 1, 2, 2)  # one is drawn for each way


def random_path(rng, seconds, home, buttons):
    """Straight ways of 20 to 200 mm/s between places in the ball."""
    rows, t, at, button = ["t,x,y,z,button"], 0.0, (0.0, 0.0, 0.9 * RADIUS), 0
    while t < seconds:
        rows.append(f"{t:.3f},{home[0] + at[0]:.5f},{home[1] + at[1]:.5f},{home[2] + at[2]:.5f},{button}")
        direction = [rng.gauss(0, 1) for _ in range(3)]
        length = RADIUS * rng.uniform(0.2, 0.95) / math.hypot(*direction)
        to = tuple(length * d for d in direction)
        t += max(0.05, math.dist(at, to) / rng.uniform(0.02, 0.2))
        at, button = to, rng.choice(buttons)
    return "\n".join(rows) + "\n"
