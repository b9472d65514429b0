# SPDX-FileCopyrightText: facet_mapping contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Mesh files for the tests: a street with kerbs of known height."""
import math
import random

CLASSES = {0: ("road", (128, 64, 128)), 1: ("sidewalk", (244, 35, 232))}
LENGTH_M = 40.0
SPACING_M = 0.5
ROAD_HALF_WIDTH_M = 3.5
SIDEWALK_M = 2.0
CROSS_SLOPE = 0.02  # the road falls toward its edges


def write_ply(path, vertices, faces, labels, classes=None, frame="map"):
    lines = ["ply", "format ascii 1.0"]
    lines += ["comment frame_id " + frame] if frame else []
    for number, (name, color) in sorted((CLASSES if classes is None else classes).items()):
        lines.append("comment class %d %d %d %d none %s" % (number, *color, name))
    lines += ["element vertex %d" % len(vertices)]
    lines += ["property double " + axis for axis in "xyz"]
    lines += ["element face %d" % len(faces), "property list uchar int vertex_indices",
              "property ushort label", "end_header"]
    lines += ["%.9g %.9g %.9g" % tuple(vertex) for vertex in vertices]
    lines += ["3 %d %d %d %d" % (*face, label) for face, label in zip(faces, labels)]
    with open(path, "w", encoding="utf-8") as file:
        file.write("\n".join(lines) + "\n")
    return path


def steps(begin, end):
    count = round(abs(end - begin) / SPACING_M)
    return [begin + (end - begin) * k / count for k in range(count + 1)]


def profile(kerb_left_m, kerb_right_m):
    """(distance to the left of the road's middle, height) from the right to the left, and the class
    of each piece between two of them."""
    edge = ROAD_HALF_WIDTH_M
    foot = -CROSS_SLOPE * edge
    right = [(y, foot + kerb_right_m) for y in steps(-edge - SIDEWALK_M, -edge)]
    road = [(y, -CROSS_SLOPE * abs(y)) for y in steps(-edge, edge)]
    left = [(y, foot + kerb_left_m) for y in steps(edge, edge + SIDEWALK_M)]
    classes = [1] * len(right) + [0] * (len(road) - 1) + [1] * len(left)
    return right + road + left, classes


def street(kerb_left_m, kerb_right_m, heading_rad=0.4, noise_m=0.003):
    """Vertices, faces and labels of a road with sidewalks, the kerbs' faces being sidewalk."""
    across, classes = profile(kerb_left_m, kerb_right_m)
    along = steps(0.0, LENGTH_M)
    noise = random.Random(1)
    cosine, sine = math.cos(heading_rad), math.sin(heading_rad)
    vertices = [(cosine * x - sine * y, sine * x + cosine * y, z + noise.gauss(0.0, noise_m))
                for x in along for y, z in across]
    faces, labels = [], []
    width = len(across)
    for row in range(len(along) - 1):
        for column, label in enumerate(classes):
            a = row * width + column
            faces += [(a, a + width, a + width + 1), (a, a + width + 1, a + 1)]
            labels += [label, label]
    return vertices, faces, labels
