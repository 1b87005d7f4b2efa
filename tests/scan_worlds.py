"""Worlds for scanners, drawn at random by family; the families were frozen before any match."""

import numpy as np

from ray_casting import World


def polygon(points):
    """Its sides as segments."""
    points = np.asarray(points, dtype=float)
    return np.hstack([points, np.roll(points, -1, axis=0)])


def rectangle(x0, y0, x1, y1):
    return polygon([(x0, y0), (x1, y0), (x1, y1), (x0, y1)])


def turned_box(center, width, depth, angle):
    c, s = np.cos(angle), np.sin(angle)
    corners = np.array([(-1, -1), (1, -1), (1, 1), (-1, 1)]) * (width / 2, depth / 2)
    return polygon(corners @ np.array([[c, s], [-s, c]]) + center)


def furniture(rng, half, count):
    """Boxes and round things in a room of this half size: segments, circles."""
    boxes, circles = [np.empty((0, 4))], [np.empty((0, 3))]
    for _ in range(count):
        center = rng.uniform(-0.9, 0.9, 2) * half
        if rng.random() < 0.65:
            angle = rng.choice([0.0, np.pi / 2, rng.uniform(0, np.pi)])
            boxes.append(turned_box(center, rng.uniform(0.4, 1.6), rng.uniform(0.3, 0.7), angle))
        else:
            circles.append([[*center, rng.uniform(0.03, 0.4)]])
    return np.vstack(boxes), np.vstack(circles)


def room(rng):
    """Four walls, two doors into a larger room, furniture."""
    half = rng.uniform((3.0, 2.0), (5.0, 4.0))
    (x, y), door = half, rng.uniform(-0.6, 0.4, 2) * half
    walls = [
        [-x, -y, door[0], -y], [door[0] + 0.9, -y, x, -y], [x, -y, x, door[1]],
        [x, door[1] + 0.9, x, y], [x, y, -x, y], [-x, y, -x, -y],
    ]  # fmt: skip
    outer = rectangle(-x - 3, -y - 4, x + 5, y + 3)
    boxes, circles = furniture(rng, half, rng.integers(4, 9))
    return World(np.vstack([walls, outer, boxes]), circles)


def empty_room(rng):
    """Four walls, nothing else."""
    x, y = rng.uniform((2.5, 1.8), (4.5, 3.5))
    return World(rectangle(-x, -y, x, y))


def corridor_walls(rng, length=120.0):
    width = rng.uniform(1.6, 3.0)
    return np.array(
        [[-length, -width / 2, length, -width / 2], [-length, width / 2, length, width / 2]]
    )


def corridor_plain(rng):
    """Two walls whose ends are out of every scanner's range: nothing tells where along it."""
    return World(corridor_walls(rng))


def corridor_doors(rng):
    """Walls with doors set back by a few centimetres, here and there one that is open."""
    walls = corridor_walls(rng, 30.0)
    out = []
    for side, (x, y, end, _) in zip((-1, 1), walls, strict=True):
        while x < end:
            wall, door = rng.uniform(1.5, 5.0), rng.uniform(0.8, 1.2)
            depth = 3.0 if rng.random() < 0.25 else rng.uniform(0.06, 0.2)
            begin, end_of_door, back = x + wall, x + wall + door, y + side * depth
            corners = np.array(
                [(x, y), (begin, y), (begin, back), (end_of_door, back), (end_of_door, y)]
            )
            out.append(np.hstack([corners[:-1], corners[1:]]))
            x += wall + door
    return World(np.vstack(out))


def corridor_pillars(rng):
    """Half pillars along both walls, at irregular distances."""
    walls = corridor_walls(rng)
    circles = []
    for _, y, _, _ in walls:
        x = -30.0
        while x < 30.0:
            x += rng.uniform(1.0, 5.0)
            circles.append((x, y, rng.uniform(0.1, 0.3)))
    return World(walls, np.array(circles))


def pillars(rng):
    """A hall of 40 m with round and square pillars: its walls are mostly out of range."""
    boxes, circles = [], []
    for _ in range(60):
        center = rng.uniform(-18, 18, 2)
        if rng.random() < 0.5:
            circles.append((*center, rng.uniform(0.15, 0.5)))
        else:
            size = rng.uniform(0.25, 0.7)
            boxes.append(turned_box(center, size, size, rng.uniform(0, np.pi / 2)))
    walls = rectangle(-20, -20, 20, 20)
    return World(np.vstack([walls, *boxes]), np.array(circles))


def glass(rng):
    """A furnished room; two of its walls are glass that most beams pass, walls behind them."""
    half = rng.uniform((3.0, 2.0), (5.0, 4.0))
    walls, outer = rectangle(*-half, *half), rectangle(*-(half + 2), *(half + 4))
    boxes, circles = furniture(rng, half, rng.integers(3, 6))
    segments = np.vstack([walls, outer, boxes])
    clear = np.zeros(len(segments))
    clear[rng.choice(4, 2, replace=False)] = rng.uniform(0.3, 0.95, 2)
    return World(segments, circles, clear)


def people(rng):
    """A furnished room with three to six walking people."""
    still = room(rng)
    count = rng.integers(3, 7)
    half = np.abs(still.segments[:6]).max(axis=0)[2:] - 0.3
    ends = rng.uniform(-1, 1, (count, 2, 2)) * half
    size, speed = rng.uniform(0.15, 0.3, (count, 1)), rng.uniform(0.5, 1.5, (count, 1))
    walkers = np.hstack([ends[:, 0], ends[:, 1], size, speed])
    return World(still.segments, still.circles, walkers=walkers)


FAMILIES = {
    "room": room,
    "empty room": empty_room,
    "corridor, doors": corridor_doors,
    "corridor, pillars": corridor_pillars,
    "corridor, plain": corridor_plain,
    "pillars": pillars,
    "glass": glass,
    "people": people,
}
