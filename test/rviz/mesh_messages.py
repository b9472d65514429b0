# SPDX-FileCopyrightText: facet_mapping contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""LabeledMesh messages of simple made-up meshes, for looking at them in rviz."""
from facet_mapping.msg import ClassPalette, LabeledMesh, LabeledMeshChunk, PaletteClass
from geometry_msgs.msg import Point32, Quaternion, TransformStamped, Vector3

CLASSES = {0: ("road", (128, 64, 128)), 1: ("building", (220, 20, 60)),
           2: ("vegetation", (107, 142, 35)), 3: ("car", (0, 0, 230))}


def palette():
    message = ClassPalette(version=1, source="made up")
    for number, (name, rgb) in CLASSES.items():
        entry = PaletteClass(id=number, name=name)
        entry.color.r, entry.color.g, entry.color.b = (value / 255.0 for value in rgb)
        entry.color.a = 1.0
        message.classes.append(entry)
    return message


def field(key, origin, cells, size_m, label, confidence=255, views=10, height=None):
    """A square of 2 * cells^2 facets; `height(x, y)` of its vertices, in metres."""
    step = size_m / cells
    places = [(column * step, row * step) for row in range(cells + 1) for column in range(cells + 1)]
    facets = []
    for row in range(cells):
        for column in range(cells):
            corner = row * (cells + 1) + column
            above = corner + cells + 1
            facets += [corner, corner + 1, above + 1, corner, above + 1, above]
    chunk = LabeledMeshChunk(key=list(key), revision=1)
    chunk.origin.x, chunk.origin.y, chunk.origin.z = origin
    chunk.vertices = [Point32(x, y, height(x + origin[0], y + origin[1]) if height else 0.0)
                      for x, y in places]
    chunk.vertex_ids = list(range(len(chunk.vertices)))
    chunk.triangles = facets
    count = 2 * cells * cells
    chunk.labels = [label] * count
    chunk.confidence = bytes([confidence] * count)
    chunk.views = [views] * count
    return chunk


def mesh(chunks, sequence=1, full=True, map_id="made-up", frame="map"):
    message = LabeledMesh(map_id=map_id, sequence=sequence, full=full, chunks=chunks,
                          palette_version=1)
    message.header.frame_id = frame
    return message


def turned(x, y):
    """From the frame of `turned_frame` to its parent."""
    return 2.0 - y, 1.0 + x


def turned_frame(parent="map", child="odom"):
    """A quarter turn to the left, then (2, 1, 0)."""
    transform = TransformStamped(child_frame_id=child)
    transform.header.frame_id = parent
    transform.transform.translation = Vector3(2.0, 1.0, 0.0)
    transform.transform.rotation = Quaternion(0.0, 0.0, 0.5 ** 0.5, 0.5 ** 0.5)
    return transform


def four_fields():
    """One field of 10 m per class, around the origin; the second unsure, the fourth 2 m high."""
    return [field((0, 0, 0), (0.0, 0.0, 0.0), 4, 10.0, 0, views=20),
            field((-1, 0, 0), (-10.0, 0.0, 0.0), 4, 10.0, 1, confidence=51, views=5),
            field((-1, -1, 0), (-10.0, -10.0, 0.0), 4, 10.0, 2, views=0),
            field((0, -1, 0), (0.0, -10.0, 2.0), 4, 10.0, 3)]
