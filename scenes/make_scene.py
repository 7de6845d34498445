#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Reckon authors
# SPDX-License-Identifier: Apache-2.0
"""Writes the shipped scenes' mesh, picture, hand traces and tracks: touchstone.obj, land.pgm, meeting_1.csv,
meeting_2.csv, hand_trace.csv, hand_trace_2.csv, wall_trace.csv, and the tracks of entities.

    make_scene.py [FOLDER]        default: the folder of this script

The touchstone is a solid of revolution about z with a smooth bowl and dome, a concave crease round its
waist, a sharp rim, and a thin fin on one meridian. The traces are where a person wants the hand to be:
minimum-jerk moves, at rest at both ends, so that they may be played in a loop. The same input gives the
same bytes.
"""
import math
import pathlib
import sys

RATE_HZ = 250
LOOP_S = 60.0
WALL_LOOP_S = 16.0
DIAGONAL = 0.2  # [m], of the bounding box

# Profile before scaling [m]: an ellipse from the bottom to the crease, a cone to the rim, a dome.
BOWL_RADIUS, BOWL_DEPTH = 0.060, 0.040
CREASE_DEG = 130.0
RIM = (0.058, 0.043)
DOME_TOP, DOME_DROP = 0.050, 0.007
FIN_HEIGHT, FIN_HALF_ANGLE = 0.012, 0.018  # [m], [rad]
FIN_FROM_DEG, FIN_TO_DEG = 30.0, 85.0


def bowl(angle):
    """Point (radius, z) and outward normal of the bowl at an angle [rad] from its lowest point."""
    s, c = math.sin(angle), math.cos(angle)
    normal = (BOWL_DEPTH * s, -BOWL_RADIUS * c)
    length = math.hypot(*normal)
    return (BOWL_RADIUS * s, -BOWL_DEPTH * c), (normal[0] / length, normal[1] / length)


def cone(share):
    """Point and outward normal between the crease (0) and the rim (1)."""
    (r0, z0), _ = bowl(math.radians(CREASE_DEG))
    dr, dz = RIM[0] - r0, RIM[1] - z0
    length = math.hypot(dr, dz)
    return (r0 + share * dr, z0 + share * dz), (dz / length, -dr / length)


def dome(radius):
    """Point and outward normal of the dome at a distance from the axis."""
    slope = -2.0 * DOME_DROP * radius / RIM[0] ** 2
    length = math.hypot(slope, 1.0)
    return (radius, DOME_TOP - DOME_DROP * (radius / RIM[0]) ** 2), (-slope / length, 1.0 / length)


def fin_height(angle):
    """How far the fin's edge stands out of the bowl."""
    share = (math.degrees(angle) - FIN_FROM_DEG) / (FIN_TO_DEG - FIN_FROM_DEG)
    return FIN_HEIGHT * math.sin(math.pi * share) ** 2 if 0.0 < share < 1.0 else 0.0


def make_mesh():
    """Vertices and triangles (outward), before scaling."""
    rings = []  # (radius, z, radius at the fin's edge, z there)
    for step in range(1, 41):
        angle = math.radians(CREASE_DEG * step / 40)
        (r, z), (nr, nz) = bowl(angle)
        rings.append((r, z, r + fin_height(angle) * nr, z + fin_height(angle) * nz))
    for step in range(1, 7):
        (r, z), _ = cone(step / 6)
        rings.append((r, z, r, z))
    for step in range(11, 0, -1):
        (r, z), _ = dome(RIM[0] * step / 12)
        rings.append((r, z, r, z))

    count = 64
    meridians = [2.0 * math.pi * i / count for i in range(count)]
    meridians = sorted(meridians + [FIN_HALF_ANGLE, 2.0 * math.pi - FIN_HALF_ANGLE])
    n = len(meridians)
    vertices = [(0.0, 0.0, -BOWL_DEPTH)]
    for r, z, fin_r, fin_z in rings:
        for angle in meridians:
            radius, height = (fin_r, fin_z) if angle == 0.0 else (r, z)
            vertices.append((radius * math.cos(angle), radius * math.sin(angle), height))
    vertices.append((0.0, 0.0, DOME_TOP))

    triangles = []
    top = len(vertices) - 1
    for j in range(n):
        k = (j + 1) % n
        triangles.append((0, 1 + k, 1 + j))
        for i in range(len(rings) - 1):
            a, b = 1 + i * n + j, 1 + i * n + k
            triangles.append((a, b, b + n))
            triangles.append((a, b + n, a + n))
        last = 1 + (len(rings) - 1) * n
        triangles.append((last + j, last + k, top))
    return vertices, triangles


def mesh_scale(vertices):
    sides = [max(v[i] for v in vertices) - min(v[i] for v in vertices) for i in range(3)]
    return DIAGONAL / math.sqrt(sum(s * s for s in sides))


def minimum_jerk(u):
    return u * u * u * (10.0 + u * (-15.0 + 6.0 * u))


class Trace:
    """Positions [m] of a hand at RATE_HZ; places are (radius, angle [rad], z) before scaling."""

    def __init__(self, scale, home):
        self.scale = scale
        self.place = home
        self.home = home
        self.rows = [self.position(home)]

    def position(self, place):
        radius, angle, z = place
        return tuple(self.scale * x for x in (radius * math.cos(angle), radius * math.sin(angle), z))

    def time(self):
        return (len(self.rows) - 1) / RATE_HZ

    def along(self, seconds, at):
        """Follows at(u), u from 0 to 1 by minimum jerk; at(0) is the present place."""
        steps = round(seconds * RATE_HZ)
        self.rows.extend(self.position(at(minimum_jerk(i / steps))) for i in range(1, steps + 1))
        self.place = at(1.0)

    def to(self, seconds, radius, angle_deg, z):
        start, end = self.place, (radius, math.radians(angle_deg), z)
        self.along(seconds, lambda u: tuple(a + u * (b - a) for a, b in zip(start, end)))

    def shift(self, seconds, dx, dy, dz):
        """Straight by a Cartesian way [m] after scaling."""
        x, y, z = (c / self.scale for c in self.position(self.place))
        angle = self.place[1]
        end = (x + dx / self.scale, y + dy / self.scale, z + dz / self.scale)

        def at(u):
            px, py = x + u * (end[0] - x), y + u * (end[1] - y)
            turn = math.remainder(math.atan2(py, px) - angle, 2.0 * math.pi)
            return math.hypot(px, py), angle + turn, z + u * (end[2] - z)

        self.along(seconds, at)

    def on(self, seconds, patch, start, end, angle_deg, depth):
        """Moves on a patch (bowl, cone or dome): parameter, angle and depth each from, to."""
        angles = tuple(math.radians(a) for a in angle_deg)

        def at(u):
            (r, z), (nr, nz) = patch(start + u * (end - start))
            below = depth[0] + u * (depth[1] - depth[0])
            return r - below * nr, angles[0] + u * (angles[1] - angles[0]), z - below * nz

        self.along(seconds, at)

    def move_to(self, seconds, patch, parameter, angle_deg, depth):
        (r, z), (nr, nz) = patch(parameter)
        self.to(seconds, r - depth * nr, angle_deg, z - depth * nz)

    def wait_until(self, seconds):
        steps = round((seconds - self.time()) * RATE_HZ)
        assert steps >= 0, f"{self.time()} s is past {seconds} s"
        self.rows.extend([self.rows[-1]] * steps)

    def close(self, seconds):
        """Goes home and stays there up to the loop's end."""
        self.to(2.5, self.home[0], math.degrees(self.home[1]), self.home[2])
        self.wait_until(seconds)

    def write(self, path):
        with open(path, "w", newline="\n") as out:
            out.write("t_s,px_m,py_m,pz_m\n")
            for i, row in enumerate(self.rows):
                out.write(f"{i / RATE_HZ:.3f}," + ",".join(f"{x + 0.0:.7f}" for x in row) + "\n")


MEETING_S = 37.0  # both hands are in place: two_hands.toml begins here
PUSH_S = 42.0     # both move on, the second pushing the first


def first_hand(scale):
    """Dome, rim, crease and bowl; then is met and pushed by the second hand."""
    hand = Trace(scale, (0.03, math.radians(90.0), 0.085))
    hand.move_to(2.0, dome, 0.03, 90.0, -0.005)
    hand.on(1.5, dome, 0.03, 0.03, (90.0, 90.0), (-0.005, 0.003))
    hand.on(4.0, dome, 0.03, 0.05, (90.0, 160.0), (0.003, 0.003))
    hand.to(1.5, RIM[0] - 0.003, 160.0, RIM[1] - 0.0015)
    hand.to(5.0, RIM[0] - 0.003, 230.0, RIM[1] - 0.0015)
    hand.to(1.5, 0.075, 230.0, 0.060)
    hand.move_to(1.5, cone, 0.5, 230.0, -0.008)
    hand.on(1.5, cone, 0.5, 0.5, (230.0, 230.0), (-0.008, 0.003))
    (r, z), _ = bowl(math.radians(CREASE_DEG))
    hand.to(3.0, r - 0.003, 230.0, z)
    hand.move_to(3.0, bowl, math.radians(105.0), 230.0, 0.003)
    hand.on(4.0, bowl, math.radians(105.0), math.radians(75.0), (230.0, 270.0), (0.003, 0.003))
    hand.on(1.5, bowl, math.radians(75.0), math.radians(75.0), (270.0, 270.0), (0.003, -0.015))
    hand.to(2.5, 0.105, 270.0, 0.030)
    hand.wait_until(PUSH_S)
    hand.shift(6.0, -0.025, 0.0, 0.0)
    hand.wait_until(54.0)
    hand.to(2.0, 0.105, 200.0, 0.085)
    hand.close(LOOP_S)
    return hand


def second_hand(scale):
    """Dome, fin and bowl; then meets the first hand, 3.5 mm into its 10 mm, and pushes it along."""
    hand = Trace(scale, (0.04, math.radians(-60.0), 0.095))
    hand.move_to(2.0, dome, 0.035, -60.0, -0.005)
    hand.on(1.5, dome, 0.035, 0.035, (-60.0, -60.0), (-0.005, 0.003))
    hand.on(4.0, dome, 0.035, 0.02, (-60.0, 20.0), (0.003, 0.003))
    hand.on(1.5, dome, 0.02, 0.02, (20.0, 20.0), (0.003, -0.015))
    hand.to(2.0, 0.085, 12.0, 0.050)
    low, high = math.radians(50.0), math.radians(65.0)
    hand.move_to(2.0, bowl, low, 10.0, -0.006)
    hand.on(2.0, bowl, low, low, (10.0, -1.5), (-0.006, -0.006))
    hand.on(3.0, bowl, low, high, (-1.5, -1.5), (-0.006, -0.006))
    hand.on(2.0, bowl, high, high, (-1.5, 20.0), (-0.006, -0.006))
    hand.on(1.5, bowl, high, high, (20.0, 22.0), (-0.006, 0.003))
    hand.on(4.0, bowl, high, math.radians(80.0), (22.0, 60.0), (0.003, 0.003))
    hand.on(1.5, bowl, math.radians(80.0), math.radians(80.0), (60.0, 60.0), (0.003, -0.02))
    # Round the outside to beside the first hand, which waits at (0, -0.105, 0.03) times scale.
    hand.to(4.5, 0.120, -65.0, 0.030)
    x, y, z = hand.position(hand.place)
    beside = (0.0215 - x, -0.105 * scale - y, 0.030 * scale - z)
    hand.shift(2.5, *beside)
    hand.wait_until(MEETING_S)
    hand.shift(4.0, -0.005, 0.0, 0.0)
    hand.wait_until(PUSH_S)
    hand.shift(6.0, -0.025, 0.0, 0.0)
    hand.wait_until(49.0)
    hand.shift(4.0, 0.007, 0.0, 0.0)
    hand.shift(1.5, 0.040, 0.0, 0.02)
    hand.close(LOOP_S)
    return hand


MEETING_LOOP_S = 20.0
# [m] that the held points of two hands press past the touch of their 10 mm balls: 2 N, by two grips of 300 N/m in
# series with 500 N/m between the hands.
PRESSED = 0.0175


def meeting_hand(scale, side):
    """One of two hands (side -1 or 1) that press each other, stroke the stone, and press again over it."""
    apart = 0.025
    place = (side * (0.010 + apart) / scale, -0.110)
    home = (math.hypot(*place), math.atan2(place[1], place[0]), 0.030)
    hand = Trace(scale, home)
    closer = -side * (apart + PRESSED / 2.0)
    hand.wait_until(0.4)
    hand.shift(1.6, closer, 0.0, 0.0)
    hand.wait_until(3.4)
    hand.shift(2.0, -0.012, 0.0, 0.0)  # the second pushes the first
    hand.shift(1.6, 0.012, 0.0, 0.0)
    hand.shift(1.0, -closer, 0.0, 0.0)
    def fly(seconds, x, y, z):
        """Straight to a place [m] after scaling."""
        at = hand.position(hand.place)
        hand.shift(seconds, x - at[0], y - at[1], z - at[2])

    # The dome, each on its side.
    begin, end = (200.0, 235.0) if side < 0 else (340.0, 305.0)
    fly(1.4, side * 0.035, -0.020, 0.075)
    hand.move_to(0.8, dome, 0.035, begin, -0.006)
    hand.on(0.6, dome, 0.035, 0.035, (begin, begin), (-0.006, 0.009))
    hand.on(3.0, dome, 0.035, 0.042, (begin, end), (0.009, 0.009))
    hand.on(0.6, dome, 0.042, 0.042, (end, end), (0.009, -0.015))
    # Over it, they meet again.
    fly(1.4, side * (0.010 + apart), 0.0, 0.080)
    hand.shift(1.2, closer, 0.0, 0.0)
    hand.wait_until(17.0)
    hand.shift(1.0, -closer, 0.0, 0.0)
    fly(1.8, *hand.position(hand.home))
    hand.wait_until(MEETING_LOOP_S)
    return hand


def wall_hand():
    """Presses 3 mm into the plane z = 0 and draws a lying eight on it."""
    hand = Trace(1.0, (0.0, 0.0, 0.05))
    hand.shift(2.0, 0.0, 0.0, -0.045)
    hand.shift(1.5, 0.0, 0.0, -0.008)

    def eight(u):
        x, y = 0.03 * math.sin(2.0 * math.pi * u), 0.015 * math.sin(4.0 * math.pi * u)
        return math.hypot(x, y), math.atan2(y, x), -0.003

    hand.along(9.0, eight)
    hand.shift(1.5, 0.0, 0.0, 0.028)
    hand.shift(1.5, 0.0, 0.0, 0.025)
    hand.wait_until(WALL_LOOP_S)
    return hand


def write_track(path, rate_hz, seconds, at):
    """Samples of at(time [s]), which gives a position [m]; the last one is the first again."""
    with open(path, "w", newline="\n") as out:
        out.write("t_s,px_m,py_m,pz_m\n")
        for i in range(round(seconds * rate_hz) + 1):
            time = i / rate_hz
            out.write(f"{time:.3f}," + ",".join(f"{x + 0.0:.6f}" for x in at(time % seconds)) + "\n")


def tip(time):
    """A robot's tip: from the left to the right, 2 s there, and back, by minimum jerk."""
    there = minimum_jerk(min(max(time - 2.0, 0.0) / 4.0, 1.0))
    back = minimum_jerk(min(max(time - 8.0, 0.0) / 4.0, 1.0))
    share = there - back
    return -0.06 + 0.12 * share, 0.0, 0.02 * math.sin(math.pi * share) ** 2


LAP_S, STRAIGHT, BEND = 60.0, 150.0, 40.0  # [s], [m], [m] radius


def truck(time):
    """Round a stadium of two straights and two bends, anticlockwise, at one speed."""
    lap = 2.0 * STRAIGHT + 2.0 * math.pi * BEND
    way = lap * time / LAP_S
    half = lap / 2.0
    side = 1.0 if way < half else -1.0
    way = way % half
    if way < STRAIGHT:
        return side * (way - STRAIGHT / 2.0), -side * BEND, 0.0
    angle = (way - STRAIGHT) / BEND
    return side * (STRAIGHT / 2.0 + BEND * math.sin(angle)), -side * BEND * math.cos(angle), 0.0


def ellipse(east, north, seconds):
    """Round an ellipse of these half axes [m], anticlockwise, once in a time."""
    def at(time):
        angle = 2.0 * math.pi * time / seconds
        return east * math.cos(angle), north * math.sin(angle), 0.0
    return at


# Once round [s], and the half axes [m].
ELLIPSES = {"walk_track.csv": (60.0, 16.0, 8.0), "flight_track.csv": (120.0, 1000.0, 600.0),
            "ferry_track.csv": (400.0, 700.0, 90.0)}


LAND = (129, 97)  # pixels


def land(x, y):
    """Height [0, 1] at a place [0, 1] x [0, 1]: a peak, a ridge, and a bowl between them, flat at the edges."""
    def hill(middle_x, middle_y, width):
        return math.exp(-((x - middle_x) ** 2 + (y - middle_y) ** 2) / width ** 2)
    edge = (16 * x * (1 - x) * y * (1 - y)) ** 0.5
    ridge = math.exp(-(x - 0.72 - 0.1 * math.sin(6 * y)) ** 2 / 0.01)
    return edge * min(1.0, max(0.0, 0.25 + 0.7 * hill(0.3, 0.6, 0.18) + 0.4 * ridge - 0.25 * hill(0.5, 0.3, 0.15)))


def write_land(file):
    """A PGM picture of 16 bits, the top row towards +y."""
    columns, rows = LAND
    with open(file, "wb") as out:
        out.write(b"P5\n# heights, written by make_scene.py\n%d %d\n65535\n" % LAND)
        for row in range(rows):
            for column in range(columns):
                height = land(column / (columns - 1), 1 - row / (rows - 1))
                out.write(round(65535 * height).to_bytes(2, "big"))


def main():
    folder = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else pathlib.Path(__file__).parent)
    vertices, triangles = make_mesh()
    scale = mesh_scale(vertices)
    with open(folder / "touchstone.obj", "w", newline="\n") as out:
        out.write("# touchstone, written by make_scene.py; metres\n")
        for v in vertices:
            out.write("v " + " ".join(f"{scale * x + 0.0:.7f}" for x in v) + "\n")
        for t in triangles:
            out.write("f " + " ".join(str(i + 1) for i in t) + "\n")
    write_land(folder / "land.pgm")
    meeting_hand(scale, -1).write(folder / "meeting_1.csv")
    meeting_hand(scale, 1).write(folder / "meeting_2.csv")
    first_hand(scale).write(folder / "hand_trace.csv")
    second_hand(scale).write(folder / "hand_trace_2.csv")
    wall_hand().write(folder / "wall_trace.csv")
    write_track(folder / "tip_track.csv", 50, 14.0, tip)
    write_track(folder / "truck_track.csv", 5, LAP_S, truck)
    for name, (seconds, east, north) in ELLIPSES.items():
        write_track(folder / name, 60.0 / seconds, seconds, ellipse(east, north, seconds))


if __name__ == "__main__":
    main()
