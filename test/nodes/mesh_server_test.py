#!/usr/bin/python3
# SPDX-FileCopyrightText: facet_mapping contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""mesh_server: a saved mesh on the mapper's topics and services; the client examples on it."""
import os
import re
import subprocess
import sys
import tempfile
import time
import unittest

import roslib.packages
import rospy
import rostest
from facet_mapping.msg import ClassPalette, LabeledMesh, Status
from facet_mapping.srv import GetMesh, LoadMesh, Refine, RefineResponse, SaveMesh
from sensor_msgs.msg import PointCloud2
from tf2_msgs.msg import TFMessage
from visualization_msgs.msg import Marker, MarkerArray

import mesh_files

PACKAGE = "facet_mapping"
# Far more than a node needs, so that a slow machine does not fail the test.
TIMEOUT_S = 30
KERB_LEFT_M, KERB_RIGHT_M = 0.12, 0.16

# The subscribers of one process share their connection: a newcomer is another process.
NEWCOMER = """
import rospy
from facet_mapping.msg import LabeledMesh
rospy.init_node("newcomer", anonymous=True)
mesh = rospy.wait_for_message("/mesh_server/mesh", LabeledMesh, timeout=%d)
print(mesh.full, mesh.map_id, sum(len(chunk.triangles) for chunk in mesh.chunks) // 3)
""" % TIMEOUT_S


class Ear:
    """Keeps the messages of a topic."""

    def __init__(self, topic, kind):
        self.messages = []
        self.subscriber = rospy.Subscriber(topic, kind, self.messages.append)

    def wait(self, done):
        """The first message for which `done` holds, None if none comes."""
        end = time.monotonic() + TIMEOUT_S
        while time.monotonic() < end:
            found = [message for message in list(self.messages) if done(message)]
            if found:
                return found[0]
            time.sleep(0.02)
        return None


def call(name, kind, **request):
    rospy.wait_for_service("/" + name, timeout=TIMEOUT_S)
    return rospy.ServiceProxy("/" + name, kind)(**request)


def load(path):
    return call("mesh_server/load_mesh", LoadMesh, path=path)


def facets_in(mesh):
    return sum(len(chunk.triangles) for chunk in mesh.chunks) // 3


class StandInRefiner:
    """Under /refiner what mesh_server shows; "refining" makes that show another file."""

    def __init__(self, refined, code=Status.OK):
        self.refined, self.code, self.requests = refined, code, []
        palette = rospy.wait_for_message("/mesh_server/palette", ClassPalette, timeout=TIMEOUT_S)
        self.publisher = rospy.Publisher("/refiner/palette", ClassPalette, latch=True, queue_size=1)
        self.publisher.publish(palette)
        self.services = [rospy.Service("/refiner/refine", Refine, self.refine),
                         rospy.Service("/refiner/get_mesh", GetMesh, self.get_mesh)]

    def refine(self, request):
        self.requests.append(request)
        if self.code == Status.OK:
            load(self.refined)
        return RefineResponse(status=Status(code=self.code, message="what the refiner says"))

    @staticmethod
    def get_mesh(request):
        return call("mesh_server/get_mesh", GetMesh, classes=request.classes)

    def close(self):
        for service in self.services:
            service.shutdown()
        self.publisher.unregister()


class MeshServerTest(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.vertices, self.faces, self.labels = mesh_files.street(KERB_LEFT_M, KERB_RIGHT_M)
        self.street = self.write("street.ply")
        self.ears = []

    def tearDown(self):
        for ear in self.ears:
            ear.subscriber.unregister()
        self.folder.cleanup()

    def file(self, name):
        return os.path.join(self.folder.name, name)

    def write(self, name, facets=None, **arguments):
        return mesh_files.write_ply(self.file(name), self.vertices, self.faces[:facets],
                                    self.labels[:facets], **arguments)

    def hear(self, topic, kind):
        self.ears.append(Ear("/mesh_server/" + topic, kind))
        return self.ears[-1]

    def show_street(self):
        answer = load(self.street)
        self.assertEqual(answer.status.code, Status.OK, answer.status.message)
        return answer

    def test_a_newcomer_gets_the_full_mesh_alone(self):
        answer = self.show_street()
        self.assertEqual((answer.path, answer.facets), (self.street, len(self.faces)))
        ear = self.hear("mesh", LabeledMesh)
        mesh = ear.wait(lambda message: True)
        self.assertTrue(mesh.full)
        self.assertEqual(mesh.header.frame_id, "map")
        self.assertEqual(facets_in(mesh), len(self.faces))
        self.assertGreater(len(mesh.chunks), 4)
        newcomer = subprocess.run([sys.executable, "-c", NEWCOMER], check=True, text=True,
                                  capture_output=True, timeout=2 * TIMEOUT_S).stdout.split()
        self.assertEqual(newcomer, ["True", mesh.map_id, str(len(self.faces))])
        self.assertEqual(len(ear.messages), 1)

    def test_another_file_comes_as_a_full_mesh_of_a_new_map(self):
        self.show_street()
        ear = self.hear("mesh", LabeledMesh)
        before = ear.wait(lambda message: True)
        load(self.write("part.ply", facets=100, frame="odom"))
        after = ear.wait(lambda message: message.map_id != before.map_id)
        self.assertTrue(after.full)
        self.assertEqual(facets_in(after), 100)
        self.assertEqual(after.header.frame_id, "odom")
        self.assertEqual(len(ear.messages), 2)

    def test_a_broken_file_is_explained_and_the_mesh_stays(self):
        self.show_street()
        with open(self.street, "rb") as file:
            content = file.read()
        broken = {"truncated.ply": content[:len(content) // 2], "garbage.ply": b"\0\1\2 no mesh",
                  "empty.ply": b"", "header.ply": content[:40],
                  "far_index.ply": re.sub(rb"\n3 0 ", b"\n3 99999999 ", content, count=1),
                  "not_finite.ply": re.sub(rb"end_header\n\S+", b"end_header\nnan", content)}
        map_id = call("mesh_server/get_mesh", GetMesh).mesh.map_id
        for name, bytes_ in broken.items():
            with open(self.file(name), "wb") as file:
                file.write(bytes_)
            status = load(self.file(name)).status
            self.assertEqual(status.code, Status.IO_ERROR, name)
            self.assertIn(name, status.message)
        for path, code, words in [(self.file("missing"), Status.IO_ERROR, "no such file"),
                                  (self.folder.name, Status.INVALID_ARGUMENT, "is a folder"),
                                  ("", Status.INVALID_ARGUMENT, "path is empty"),
                                  ("mesh.obj", Status.INVALID_ARGUMENT, ".ply files only")]:
            status = load(path).status
            self.assertEqual(status.code, code, path)
            self.assertIn(words, status.message)
        answer = call("mesh_server/get_mesh", GetMesh)
        self.assertEqual((answer.mesh.map_id, facets_in(answer.mesh)), (map_id, len(self.faces)))

    def test_a_missing_file_at_the_start_leaves_the_node_alive(self):
        answer = call("server_without_file/get_mesh", GetMesh)
        self.assertEqual(answer.status.code, Status.NOT_READY)
        self.assertIn("load_mesh", answer.status.message)
        answer = call("server_without_file/load_mesh", LoadMesh, path=self.street)
        self.assertEqual(answer.facets, len(self.faces))

    def test_get_mesh_by_class_and_save_mesh(self):
        self.show_street()
        for number in (0, 1):
            answer = call("mesh_server/get_mesh", GetMesh, classes=[number])
            self.assertEqual(facets_in(answer.mesh), self.labels.count(number))
            self.assertEqual({label for c in answer.mesh.chunks for label in c.labels}, {number})
        saved = call("mesh_server/save_mesh", SaveMesh, path=self.file("saved"), classes=[1])
        self.assertEqual(saved.facets, self.labels.count(1))
        self.assertEqual(load(saved.path).facets, saved.facets)

    def test_the_palette_is_latched_and_follows_the_file(self):
        self.show_street()
        ear = self.hear("palette", ClassPalette)
        first = ear.wait(lambda message: True)
        self.assertEqual([(c.id, c.name) for c in first.classes], [(0, "road"), (1, "sidewalk")])
        self.assertAlmostEqual(first.classes[0].color.r, 128 / 255, places=5)
        load(self.write("other.ply", classes={0: ("street", (1, 2, 3)), 1: ("kerb", (4, 5, 6))}))
        second = ear.wait(lambda message: message.version > first.version)
        self.assertEqual([c.name for c in second.classes], ["street", "kerb"])
        self.assertEqual(second.source, self.file("other.ply"))
        mesh = call("mesh_server/get_mesh", GetMesh).mesh
        self.assertEqual(mesh.palette_version, second.version)

    def test_a_label_without_a_class_is_served(self):
        load(self.write("few_classes.ply", classes={0: mesh_files.CLASSES[0]}))
        self.assertEqual(facets_in(call("mesh_server/get_mesh", GetMesh).mesh), len(self.faces))
        ear = self.hear("mesh_marker", MarkerArray)
        markers = ear.wait(lambda message: True).markers
        self.assertEqual({marker.ns for marker in markers}, {"road", "class 1"})

    def test_markers_are_one_per_class_and_decimated(self):
        self.show_street()
        ear = self.hear("mesh_marker", MarkerArray)
        markers = ear.wait(lambda message: True).markers
        self.assertEqual({marker.ns for marker in markers}, {"road", "sidewalk"})
        self.assertEqual(len(markers), 2)
        shown = sum(len(marker.points) for marker in markers) // 3
        self.assertTrue(0 < shown <= 400 < len(self.faces), shown)
        load(self.write("other.ply", classes={0: ("street", (1, 2, 3)), 1: ("kerb", (4, 5, 6))}))
        after = ear.wait(lambda message: any(m.ns == "street" for m in message.markers)).markers
        actions = {marker.ns: marker.action for marker in after}
        self.assertEqual(actions, {"road": Marker.DELETE, "sidewalk": Marker.DELETE,
                                   "street": Marker.ADD, "kerb": Marker.ADD})
        self.assertTrue(all(message.markers for message in ear.messages))

    def test_points_have_labels(self):
        self.show_street()
        cloud = self.hear("mesh_points", PointCloud2).wait(lambda message: True)
        self.assertEqual(cloud.width * cloud.height, len(self.faces))
        self.assertIn("label", [field.name for field in cloud.fields])

    def test_the_frame_is_tied_to_the_parent(self):
        load(self.write("odom.ply", frame="odom_of_the_drive"))
        ear = Ear("/tf_static", TFMessage)
        self.ears.append(ear)
        self.assertIsNotNone(ear.wait(lambda message: any(
            (t.header.frame_id, t.child_frame_id) == ("inspect", "odom_of_the_drive")
            for t in message.transforms)))

    def check_kerb_heights(self, name):
        self.show_street()
        program = roslib.packages.find_node(PACKAGE, name)[0]
        output = subprocess.run([program, "_mesh_node:=/mesh_server"], check=True, text=True,
                                capture_output=True, timeout=2 * TIMEOUT_S).stdout
        for side, expected in (("left", KERB_LEFT_M), ("right", KERB_RIGHT_M)):
            found = re.search(side + r": median (\S+) m of (\d+) stations", output)
            self.assertIsNotNone(found, output)
            self.assertAlmostEqual(float(found.group(1)), expected, delta=0.005)
            self.assertGreaterEqual(int(found.group(2)), 18)

    def test_kerb_height_in_cpp(self):
        self.check_kerb_heights("kerb_height")

    def test_kerb_height_in_python(self):
        self.check_kerb_heights("kerb_height.py")

    def run_with_refiner(self, name, code=Status.OK):
        """What the program says with `_refine:=true`, and the requests that came."""
        self.show_street()
        vertices, faces, labels = mesh_files.street(0.20, 0.05)
        refined = mesh_files.write_ply(self.file("refined.ply"), vertices, faces, labels)
        refiner = StandInRefiner(refined, code)
        self.addCleanup(refiner.close)
        program = roslib.packages.find_node(PACKAGE, name)[0]
        done = subprocess.run([program, "_mesh_node:=/refiner", "_refine:=true"], text=True,
                              capture_output=True, timeout=2 * TIMEOUT_S)
        refiner.close()
        return done, refiner.requests

    def test_kerb_height_of_the_refined_mesh(self):
        for name in ("kerb_height", "kerb_height.py"):
            done, requests = self.run_with_refiner(name)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertEqual([list(request.classes) for request in requests], [[0, 1]])
            self.assertIn("what the refiner says", done.stdout)
            for side, expected in (("left", 0.20), ("right", 0.05)):
                found = re.search(side + r": median (\S+) m", done.stdout)
                self.assertIsNotNone(found, done.stdout)
                self.assertAlmostEqual(float(found.group(1)), expected, delta=0.005)

    def test_kerb_height_ends_when_the_refiner_refuses(self):
        for name in ("kerb_height", "kerb_height.py"):
            done, _ = self.run_with_refiner(name, Status.BUSY)
            self.assertEqual(done.returncode, 1, done.stdout)
            self.assertIn("what the refiner says", done.stderr)

    def test_kerb_height_says_what_is_missing(self):
        load(self.write("other.ply", classes={0: ("street", (1, 2, 3)), 1: ("kerb", (4, 5, 6))}))
        for name in ("kerb_height", "kerb_height.py"):
            program = roslib.packages.find_node(PACKAGE, name)[0]
            done = subprocess.run([program, "_mesh_node:=/mesh_server"], text=True,
                                  capture_output=True, timeout=2 * TIMEOUT_S)
            self.assertEqual(done.returncode, 1)
            self.assertIn("error: the class list has no", done.stderr)


if __name__ == "__main__":
    rospy.init_node("saved_mesh")
    rostest.rosrun(PACKAGE, "saved_mesh", MeshServerTest, sys.argv)
