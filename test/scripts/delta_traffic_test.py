#!/usr/bin/python3
# SPDX-FileCopyrightText: facet_mapping contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The sums of scripts/measure_delta_traffic on made-up messages.

Usage: delta_traffic_test.py PROGRAM_FOLDER
"""
import io
import os
import sys
import tempfile
import unittest

ROOT = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..")
sys.path.insert(0, os.path.join(ROOT, "scripts"))
if len(sys.argv) > 1:
    sys.path.insert(0, os.path.join(sys.argv.pop(1), "..", "python3", "dist-packages"))

import delta_traffic  # noqa: E402
import drive_laps  # noqa: E402
import rosbag  # noqa: E402
import rospy  # noqa: E402
from facet_mapping.msg import LabeledMesh, LabeledMeshChunk  # noqa: E402
from geometry_msgs.msg import Point32, Quaternion, TransformStamped, Vector3  # noqa: E402
from sensor_msgs.msg import Image  # noqa: E402
from tf2_msgs.msg import TFMessage  # noqa: E402


def chunk(key, facets, label=0):
    return LabeledMeshChunk(
        key=key, vertices=[Point32(float(v), 0.0, 1.0) for v in range(facets + 2)],
        vertex_ids=[100 * key[0] + v for v in range(facets + 2)],
        triangles=[v + f for f in range(facets) for v in range(3)],
        labels=[label] * facets, confidence=[9] * facets, views=[1] * facets)


def message(second, chunks, removed=(), full=False):
    mesh = LabeledMesh(map_id="a1", full=full, chunks=chunks, removed_keys=list(removed))
    mesh.header.frame_id = "map"
    mesh.header.stamp.secs = second
    return mesh


def add(traffic, mesh):
    buffer = io.BytesIO()
    mesh.serialize(buffer)
    traffic.add(mesh, len(buffer.getvalue()))
    return len(buffer.getvalue())


STEP = drive_laps.Rigid((0.0, 0.1, 0.2, 1.0), (1.0, 0.2, -0.1))  # of a drive that turns


def write_drive(path, frames):
    pose = drive_laps.Rigid((0.3, 0.0, 0.0, 1.0), (5.0, 6.0, 7.0))
    with rosbag.Bag(path, "w") as bag:
        bag.write("/tf_static", TFMessage([TransformStamped()]), rospy.Time(100))
        for k in range(frames):
            image, transform = Image(), TransformStamped()
            image.header.stamp = transform.header.stamp = rospy.Time(100 + k)
            transform.transform.translation = Vector3(*pose.translation)
            transform.transform.rotation = Quaternion(*pose.rotation)
            bag.write("/tf", TFMessage([transform]), rospy.Time(100 + k))
            bag.write("/image", image, rospy.Time(100 + k))
            pose = pose * STEP


class DriveLapsTest(unittest.TestCase):
    def test_each_lap_goes_on_where_the_one_before_ended(self):
        with tempfile.TemporaryDirectory() as folder:
            short, long = os.path.join(folder, "short.bag"), os.path.join(folder, "long.bag")
            write_drive(short, 4)
            drive_laps.write_laps(short, 3, long)
            with rosbag.Bag(long) as bag:
                messages = list(bag.read_messages())
        self.assertEqual([topic for topic, _, _ in messages].count("/tf_static"), 1)
        images = [message for topic, message, _ in messages if topic == "/image"]
        self.assertEqual([i.header.stamp.to_sec() for i in images], list(range(100, 112)))
        self.assertTrue(all(m.header.stamp == t for topic, m, t in messages if topic == "/image"))
        poses = [drive_laps.pose_of(m.transforms[0].transform)
                 for topic, m, _ in messages if topic == "/tf"]
        for before, after in zip(poses, poses[1:]):
            step = before.inverse() * after
            for a, b in zip(step.rotation + step.translation, STEP.rotation + STEP.translation):
                self.assertAlmostEqual(a, b)


class DeltaTrafficTest(unittest.TestCase):
    def test_whole_mesh_is_what_a_full_message_would_hold(self):
        traffic = delta_traffic.Traffic()
        add(traffic, message(0, [], full=True))
        self.assertEqual(traffic.updates, [])
        parts = {number: chunk((number, 0, 0), 10 * number) for number in (1, 2, 3)}
        first = add(traffic, message(1, [parts[1], parts[2]]))
        second = add(traffic, message(3, [parts[3]], removed=(1, 0, 0)))
        whole = add(delta_traffic.Traffic(), message(3, [parts[2], parts[3]]))
        self.assertEqual([u[0] for u in traffic.updates], [1.0, 3.0])
        self.assertEqual([u[1:] for u in traffic.updates], [(first, first, 30), (second, whole, 50)])
        last_row = delta_traffic.table_of(traffic.updates).splitlines()[-1].split(" | ")
        self.assertEqual(last_row[0], "| 2.0")
        self.assertIn("1/%.1f" % ((first + whole) / (first + second)), last_row)

    def test_facets_are_told_apart(self):
        traffic = delta_traffic.Traffic()
        add(traffic, message(1, [chunk((1, 0, 0), 10)]))
        add(traffic, message(2, [chunk((1, 0, 0), 12)]))
        add(traffic, message(3, [chunk((1, 0, 0), 12, label=5)]))
        self.assertEqual(traffic.sent, {"new": 12, "same": 10, "other attributes": 12})


if __name__ == "__main__":
    unittest.main()
