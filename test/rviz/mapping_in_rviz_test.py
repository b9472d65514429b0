#!/usr/bin/python3
# SPDX-FileCopyrightText: facet_mapping contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What rviz shows while the nodes map a drive, and of saved meshes. Each picture is compared with
the mapper's own mesh. With FACET_MAPPING_PICTURES=FOLDER the pictures are kept."""
import os
import pathlib
import signal
import sys
import tempfile
import unittest

import rosgraph
import rospy
import rostest
from facet_mapping.msg import ClassPalette, Status
from facet_mapping.srv import GetMesh, LoadMesh, Reset, SaveMesh

import rviz_window
from mesh_relay import MeshRelay
from street_drive import LEFT, SeenFromAbove, StreetDrive, wait_until

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "nodes"))
import mesh_files  # noqa: E402

BACKGROUND = (32, 36, 40)
UNKNOWN_CLASS = (255, 0, 255)
TOLERANCE = 3  # of 255: rounding on the way through the graphics library
ROAD, SIDEWALK = 0, 1
SHARE = 0.997  # of the places that have to be right: the rest lie where two facets meet
LOOK = "Unseen Facets: false"  # the lid over the street is in the way
VIEW = rviz_window.View(scale=20, x=18, y=0)
HALF_WIDTH_M, HALF_HEIGHT_M = 22, 17  # of what is compared
PICTURES = os.environ.get("FACET_MAPPING_PICTURES")


def is_near(a, b):
    return all(abs(x - y) <= TOLERANCE for x, y in zip(a, b))


def call(name, kind, **request):
    answer = rospy.ServiceProxy(name, kind)(**request)
    assert answer.status.code == Status.OK, answer.status.message
    return answer


def palette_of(node):
    palette = rospy.wait_for_message(node + "/palette", ClassPalette, rviz_window.TIMEOUT_S)
    return {entry.id: tuple(round(255 * value)
                            for value in (entry.color.r, entry.color.g, entry.color.b))
            for entry in palette.classes}


def is_in_view(place):
    return abs(place[0] - VIEW.x) < HALF_WIDTH_M and abs(place[1] - VIEW.y) < HALF_HEIGHT_M


def share_seen(picture, places, color):
    return sum(is_near(picture.at(*place), color) for place in places) / len(places)


def rectangle(x_begin, x_end, y_begin, y_end):
    """Places a quarter of a metre apart."""
    return [(x / 4, y / 4) for x in range(round(4 * x_begin), round(4 * x_end))
            for y in range(round(4 * y_begin), round(4 * y_end))]


ALL_OF_THE_VIEW = rectangle(VIEW.x - HALF_WIDTH_M, VIEW.x + HALF_WIDTH_M, -HALF_HEIGHT_M,
                            HALF_HEIGHT_M)


def share_equal(a, b):
    return sum(a.at(*place) == b.at(*place) for place in ALL_OF_THE_VIEW) / len(ALL_OF_THE_VIEW)


class MappingInRvizTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        if rviz_window.missing():
            raise unittest.SkipTest("not installed: " + ", ".join(rviz_window.missing()))
        rospy.init_node("mapping_in_rviz_test")
        cls.drive = StreetDrive(frames=12)
        cls.drive.wait_for_nodes({"/stereo_points": LEFT})
        cls.colors = palette_of("/mapper")
        cls.window = rviz_window.RvizWindow(rosgraph.get_master_uri())
        cls.addClassCleanup(cls.window.close)
        cls.window.view = VIEW
        cls.window.start(LOOK)

    def setUp(self):
        if not self.window.is_alive():
            self.window.start(LOOK)
        call("/mapper/reset", Reset)
        self.drive.start_again()

    def load(self, topic="/mapper/mesh"):
        self.window.topic = topic
        self.window.load(LOOK)

    def expect(self, is_right, what, name=""):
        """The first picture that is right."""
        path = PICTURES and os.path.join(PICTURES, self.id().split(".")[-1] + name + ".png")
        picture = self.window.wait_for(is_right, path)
        self.assertTrue(self.window.is_alive(), "rviz has ended")
        self.assertTrue(is_right(picture), what + " was not to be seen")
        return picture

    def expect_mesh_of(self, node, colors=None, name=""):
        """Everywhere the class that the mesh of the node has there. The picture, and the places
        looked at by class."""
        colors = {None: BACKGROUND, **(colors or self.colors)}
        seen = SeenFromAbove(call(node + "/get_mesh", GetMesh).mesh).classes()
        places = {}
        for place, label in seen.items():
            if is_in_view(place):
                places.setdefault(label, []).append(place)
        for label in (ROAD, SIDEWALK):
            self.assertGreater(len(places.get(label, [])), 100, "too little to look at")

        def is_right(picture):
            right = sum(len(found) * share_seen(picture, found, colors.get(label, UNKNOWN_CLASS))
                        for label, found in places.items())
            return right >= SHARE * sum(map(len, places.values()))

        return self.expect(is_right, "the mesh of " + node, name), places

    def expect_nothing(self, name=""):
        self.expect(lambda p: share_seen(p, ALL_OF_THE_VIEW, BACKGROUND) == 1.0, "an empty view",
                    name)

    def test_colors_appear_while_driving(self):
        """The road and the sidewalk beside it, at their known places; first near, then far."""
        self.load()
        self.expect_nothing()
        self.drive.drive_on(2)
        near, far = rectangle(9, 14, 0, 4), rectangle(24, 27, 0, 4)
        beside = rectangle(15, 17, 8, 10)
        road, sidewalk = self.colors[ROAD], self.colors[SIDEWALK]
        self.expect(lambda p: share_seen(p, near, road) > 0.9
                    and share_seen(p, beside, sidewalk) > 0.6
                    and share_seen(p, far, road) == 0.0, "the road's begin", "_begin")
        self.drive.drive_on(10)
        self.expect(lambda p: share_seen(p, near + far, road) > 0.9, "more of the road", "_end")
        self.expect_mesh_of("/mapper", name="_end")

    def test_rviz_started_after_the_drive(self):
        self.window.stop()
        self.drive.drive_on(12)
        self.window.topic = "/mapper/mesh"
        self.window.start(LOOK)
        self.expect_mesh_of("/mapper")

    def test_rviz_killed_in_mid_drive_and_restarted(self):
        self.load()
        self.drive.drive_on(3)
        _, before = self.expect_mesh_of("/mapper", name="_before")
        self.window.stop(signal.SIGKILL)
        self.drive.drive_on(3)
        self.window.start(LOOK)
        _, after = self.expect_mesh_of("/mapper", name="_after")
        self.drive.drive_on(6)
        _, end = self.expect_mesh_of("/mapper", name="_end")
        self.assertGreater(len(after[ROAD]), 1.05 * len(before[ROAD]))
        self.assertGreater(len(end[ROAD]), 1.05 * len(after[ROAD]))

    def test_reset_empties_the_view_and_a_new_map_follows(self):
        self.load()
        self.drive.drive_on(12)
        _, before = self.expect_mesh_of("/mapper", name="_before")
        call("/mapper/reset", Reset)
        self.expect_nothing("_reset")
        self.drive.start_again()
        self.drive.drive_on(2)
        _, after = self.expect_mesh_of("/mapper", name="_after")
        self.assertGreater(len(before[ROAD]), 1.2 * len(after[ROAD]))

    def lose_a_message(self, relay):
        """The display is left behind by one message, then gets the next."""
        self.addCleanup(relay.close)
        self.drive.drive_on(4)
        self.load(relay.mesh_topic)
        self.expect_mesh_of("/mapper", name="_before")
        relay.to_lose = 1
        self.drive.drive_on(1)
        wait_until(lambda: relay.lost == 1, "the message to lose")
        self.drive.drive_on(2)
        found, _ = self.expect_mesh_of("/mapper", name="_after")
        self.load()
        self.expect(lambda p: share_equal(p, found) > 0.999, "the same without a loss", "_other")

    def test_after_a_lost_message_get_mesh_completes_the_view(self):
        relay = MeshRelay("/lossy")
        self.lose_a_message(relay)
        self.assertEqual((relay.calls, relay.newcomers), (1, 1))

    def test_after_a_lost_message_without_get_mesh_the_view_is_complete_again(self):
        relay = MeshRelay("/lossy_alone", with_get_mesh=False)
        self.lose_a_message(relay)
        self.assertEqual(relay.newcomers, 2)

    def test_a_class_that_the_palette_lacks(self):
        relay = MeshRelay("/incomplete", without_class=ROAD)
        self.addCleanup(relay.close)
        self.drive.drive_on(4)
        self.load(relay.mesh_topic)
        self.expect_mesh_of("/mapper", {**self.colors, ROAD: UNKNOWN_CLASS})
        relay.show_all_classes()
        self.expect_mesh_of("/mapper", name="_later")

    def test_another_saved_mesh_replaces_the_first(self):
        self.drive.drive_on(6)
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        saved = call("/mapper/save_mesh", SaveMesh, path=os.path.join(folder.name, "saved.ply"))
        call("/mesh_server/load_mesh", LoadMesh, path=saved.path)
        self.load("/mesh_server/mesh")
        self.expect_mesh_of("/mesh_server", name="_first")
        colors = {ROAD: (10, 200, 250), SIDEWALK: (250, 120, 0)}
        other = mesh_files.write_ply(
            os.path.join(folder.name, "other.ply"), *mesh_files.street(0.12, 0.16),
            classes={ROAD: ("street", colors[ROAD]), SIDEWALK: ("pavement", colors[SIDEWALK])})
        call("/mesh_server/load_mesh", LoadMesh, path=other)
        self.expect_mesh_of("/mesh_server", colors, name="_other")
        os.truncate(saved.path, os.path.getsize(saved.path) // 2)
        answer = rospy.ServiceProxy("/mesh_server/load_mesh", LoadMesh)(path=saved.path)
        self.assertEqual(answer.status.code, Status.IO_ERROR)
        self.expect_mesh_of("/mesh_server", colors, name="_broken")
        self.load("/mesh_server/mesh")  # what a newcomer gets
        self.expect_mesh_of("/mesh_server", colors, name="_broken_newcomer")


if __name__ == "__main__":
    rostest.rosrun("facet_mapping", "mapping_in_rviz", MappingInRvizTest, sys.argv)
