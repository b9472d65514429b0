#!/usr/bin/python3
# SPDX-FileCopyrightText: facet_mapping contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""How a Python node of your own uses the labelled mesh: asks for road and sidewalk, walks along the
road and prints how high the kerb is on both sides (src/tools/kerb_height.cpp in Python).

rosrun facet_mapping kerb_height.py _mesh_node:=/mapper
rosrun facet_mapping kerb_height.py _mesh_node:=/refiner _refine:=true
"""
import sys

import numpy
import rospy
from facet_mapping.msg import ClassPalette, Status
from facet_mapping.srv import GetMesh, Refine

WAIT_S = 30.0
SAMPLE_SPACING_M = 0.1
MIN_UP = 0.7          # of the normal: the kerb's face is neither road nor sidewalk
STATION_M = 2.0       # one height per side and so much road
BAND_M = (0.2, 1.2)   # from the border: nearer is rounded, farther says little about it
MAX_GAP_M = 1.0       # between road and sidewalk, where both touch the border
MIN_SAMPLES = 20


def call(name, kind, **request):
    rospy.wait_for_service(name, timeout=WAIT_S)
    answer = rospy.ServiceProxy(name, kind)(**request)
    if answer.status.code != Status.OK:
        raise RuntimeError(answer.status.message)
    return answer


def triangles_of(mesh):
    """Corners (n, 3, 3) in the map frame and labels (n) of the facets that images saw."""
    corners, labels = [], []
    for chunk in mesh.chunks:
        origin = numpy.array([chunk.origin.x, chunk.origin.y, chunk.origin.z])
        vertices = origin + numpy.array([(v.x, v.y, v.z) for v in chunk.vertices])
        seen = numpy.array(chunk.views) > 0 if chunk.views else slice(None)
        corners.append(vertices[numpy.reshape(chunk.triangles, (-1, 3))][seen])
        labels.append(numpy.array(chunk.labels)[seen])
    if not corners:
        raise RuntimeError("the mesh has neither road nor sidewalk")
    return numpy.concatenate(corners), numpy.concatenate(labels)


def samples_of(corners):
    """Points on a facet, at most SAMPLE_SPACING_M apart."""
    a, u, v = corners[0], corners[1] - corners[0], corners[2] - corners[0]
    longest = max(numpy.linalg.norm(edge) for edge in (u, v, u - v))
    steps = max(1, int(numpy.ceil(longest / SAMPLE_SPACING_M)))
    i, j = numpy.meshgrid(numpy.arange(steps), numpy.arange(steps))
    inside = i + j < steps
    return (a + numpy.outer((i[inside] + 1 / 3) / steps, u)
            + numpy.outer((j[inside] + 1 / 3) / steps, v))


def axis_of(corners, areas):
    """Middle of the road and the direction in which it extends most, seen from above."""
    points, weights = corners[:, :, :2].reshape(-1, 2), numpy.repeat(areas, 3)
    origin = numpy.average(points, axis=0, weights=weights)
    along = numpy.linalg.eigh(numpy.cov((points - origin).T, aweights=weights))[1][:, 1]
    return origin, -along if tuple(numpy.where(abs(along) > 1e-9, along, 0)) < (0, 0) else along


def height_at(border, samples):
    distance = samples[:, 0] - border
    band = (abs(distance) >= BAND_M[0]) & (abs(distance) <= BAND_M[1])
    if band.sum() < MIN_SAMPLES:
        return numpy.nan
    return numpy.polyfit(distance[band], samples[band, 1], 1)[1]


def kerb_height(road, sidewalk):
    """From (distance from the axis, height) of both; NaN where they do not meet."""
    if min(len(road), len(sidewalk)) < MIN_SAMPLES:
        return numpy.nan
    road_end = numpy.quantile(road[:, 0], 0.98)
    sidewalk_begin = numpy.quantile(sidewalk[:, 0], 0.02)
    if abs(sidewalk_begin - road_end) > MAX_GAP_M:
        return numpy.nan
    border = 0.5 * (road_end + sidewalk_begin)
    return height_at(border, sidewalk) - height_at(border, road)


def heights_of(corners, labels, road):
    """(station in metres, side, height) along the road."""
    crosses = numpy.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    areas = numpy.linalg.norm(crosses, axis=1)
    up = crosses[:, 2] > MIN_UP * areas
    corners, labels, areas = corners[up], labels[up], areas[up]
    if not (labels == road).any():
        raise RuntimeError("the mesh has no road")
    origin, along = axis_of(corners[labels == road], areas[labels == road])
    pieces = [samples_of(facet) for facet in corners]
    is_road = numpy.repeat(labels == road, [len(piece) for piece in pieces])
    points = numpy.concatenate(pieces)
    flat = points[:, :2] - origin
    lateral = flat @ numpy.array([-along[1], along[0]])
    stations = numpy.floor(flat @ along / STATION_M)
    profile = numpy.column_stack([abs(lateral), points[:, 2]])
    for station in numpy.unique(stations):
        for side, mine in (("left", lateral > 0), ("right", lateral <= 0)):
            here = (stations == station) & mine
            height = kerb_height(profile[here & is_road], profile[here & ~is_road])
            if numpy.isfinite(height):
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
    heights = list(heights_of(*triangles_of(answer.mesh), road))
    print("station_m side height_m")
    for row in heights:
        print("%.1f %s %.3f" % row)
    for side in ("left", "right"):
        mine = [height for _, its_side, height in heights if its_side == side]
        print("%s: median %.3f m of %d stations" % (side, numpy.median(mine), len(mine)) if mine
              else side + ": no border between road and sidewalk")


if __name__ == "__main__":
    try:
        main()
    except (RuntimeError, rospy.ROSException) as error:
        sys.exit("error: %s" % error)
