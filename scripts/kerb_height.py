#!/usr/bin/python3
# SPDX-FileCopyrightText: facet_mapping contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""How a Python node of your own uses the labelled mesh: asks for road and sidewalk, walks along the
road and prints how high the kerb is on both sides (src/tools/kerb_height.cpp in Python).

rosrun facet_mapping kerb_height.py _mesh_node:=/mapper
rosrun facet_mapping kerb_height.py _mesh_node:=/refiner _refine:=true
"""
import math
import statistics
import sys
from collections import defaultdict

import rospy
from facet_mapping.msg import ClassPalette, Status
from facet_mapping.srv import GetMesh, Refine

WAIT_S = 30.0
SAMPLE_SPACING_M = 0.1
MIN_UP = 0.7          # of the normal: the kerb's face is neither road nor sidewalk
STATION_M = 2.0       # one height per side and so much road
BAND_M = (0.2, 1.5)   # from the border: nearer is rounded, farther says little about it
MIN_SAMPLES = 20


def call(name, kind, **request):
    rospy.wait_for_service(name, timeout=WAIT_S)
    answer = rospy.ServiceProxy(name, kind)(**request)
    if answer.status.code != Status.OK:
        raise RuntimeError(answer.status.message)
    return answer


def facets_of(mesh):
    """Corners in the map frame and label of each facet that images saw and that looks upward."""
    for chunk in mesh.chunks:
        o = chunk.origin
        vertices = [(o.x + v.x, o.y + v.y, o.z + v.z) for v in chunk.vertices]
        for facet, label in enumerate(chunk.labels):
            corners = [vertices[k] for k in chunk.triangles[3 * facet:3 * facet + 3]]
            x, y, z = cross(corners)
            is_seen = not chunk.views or chunk.views[facet] > 0
            if is_seen and z > MIN_UP * math.sqrt(x * x + y * y + z * z):
                yield corners, label


def cross(corners):
    """Normal times twice the area."""
    (ux, uy, uz), (vx, vy, vz) = ([p - q for p, q in zip(corner, corners[0])]
                                  for corner in corners[1:])
    return uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx


def samples_of(corners):
    """Points on a facet, at most SAMPLE_SPACING_M apart."""
    a, b, c = corners
    steps = max(1, math.ceil(max(math.dist(a, b), math.dist(b, c), math.dist(c, a))
                             / SAMPLE_SPACING_M))
    for i in range(steps):
        for j in range(steps - i):
            s, t = (i + 1 / 3) / steps, (j + 1 / 3) / steps
            yield [p + s * (q - p) + t * (r - p) for p, q, r in zip(a, b, c)]


def axis_of(road):
    """Middle of the road and the direction in which it extends most, seen from above."""
    samples = [point for corners in road for point in samples_of(corners)]
    if not samples:
        raise RuntimeError("the mesh has no road")
    x, y = (statistics.fmean(column) for column in list(zip(*samples))[:2])
    xx, xy, yy = (statistics.fmean(products) for products in zip(
        *(((p[0] - x) ** 2, (p[0] - x) * (p[1] - y), (p[1] - y) ** 2) for p in samples)))
    angle = 0.5 * math.atan2(2 * xy, xx - yy)
    return x, y, math.cos(angle), math.sin(angle)


def border_of(road, sidewalk):
    """The distance from the axis with the fewest samples on the wrong side of it."""
    samples = sorted([(d, 1) for d, _ in road] + [(d, -1) for d, _ in sidewalk])
    wrong = best = len(road)
    border = samples[0][0]
    for distance, step in samples:
        wrong -= step
        if wrong < best:
            best, border = wrong, distance
    return border


def height_at(border, samples, side):
    """Of the line through the samples in the band on one side (1: outside) of the border; None with
    too few."""
    band = [(distance - border, z) for distance, z in samples
            if BAND_M[0] <= side * (distance - border) <= BAND_M[1]]
    if len(band) < MIN_SAMPLES:
        return None
    mean, height = (statistics.fmean(column) for column in zip(*band))
    spread = sum((distance - mean) ** 2 for distance, _ in band)
    slope = sum((distance - mean) * (z - height) for distance, z in band) / max(spread, 1e-12)
    return height - slope * mean


def kerb_height(road, sidewalk):
    """From (distance from the axis, height) of both; None where they do not meet."""
    if not road or not sidewalk:
        return None
    border = border_of(road, sidewalk)
    heights = height_at(border, sidewalk, 1), height_at(border, road, -1)
    return None if None in heights else heights[0] - heights[1]


def heights_of(mesh, road):
    """(station in metres, side, height) along the road."""
    facets = list(facets_of(mesh))
    x, y, cosine, sine = axis_of([corners for corners, label in facets if label == road])
    profiles = defaultdict(lambda: ([], []))  # of road and of sidewalk, by station and side
    for corners, label in facets:
        for px, py, pz in samples_of(corners):
            along = cosine * (px - x) + sine * (py - y)
            left = cosine * (py - y) - sine * (px - x)
            place = math.floor(along / STATION_M), "left" if left > 0 else "right"
            profiles[place][0 if label == road else 1].append((abs(left), pz))
    for (station, side), profile in sorted(profiles.items()):
        height = kerb_height(*profile)
        if height is not None:
            yield (station + 0.5) * STATION_M, side, height


def main():
    rospy.init_node("kerb_height", anonymous=True)
    mesh_node = rospy.get_param("~mesh_node", "/mapper")
    palette = rospy.wait_for_message(mesh_node + "/palette", ClassPalette, timeout=WAIT_S)
    ids = {entry.name: entry.id for entry in palette.classes}
    names = [rospy.get_param("~road", "road"), rospy.get_param("~sidewalk", "sidewalk")]
    if not all(name in ids for name in names):
        raise RuntimeError("the class list has no '%s' or no '%s'; set ~road and ~sidewalk"
                           % tuple(names))
    road, sidewalk = (ids[name] for name in names)
    if rospy.get_param("~refine", False):
        print(call(mesh_node + "/refine", Refine, classes=[road, sidewalk]).status.message)
    answer = call(mesh_node + "/get_mesh", GetMesh, classes=[road, sidewalk])
    heights = list(heights_of(answer.mesh, road))
    print("station_m side height_m")
    for row in heights:
        print("%.1f %s %.3f" % row)
    for side in ("left", "right"):
        mine = [height for _, its_side, height in heights if its_side == side]
        print("%s: median %.3f m of %d stations" % (side, statistics.median(mine), len(mine)) if mine
              else side + ": no border between road and sidewalk")


if __name__ == "__main__":
    try:
        main()
    except (RuntimeError, rospy.ROSException) as error:
        sys.exit("error: %s" % error)
