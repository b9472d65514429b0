#!/usr/bin/python3
# SPDX-FileCopyrightText: facet_mapping contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The tool "Inspect Facet" in a real rviz: clicks on known facets. With FACET_MAPPING_PICTURES=FOLDER
the pictures are kept."""
import os
import sys
import threading
import time
import unittest

import rosgraph
import rospy
import rostest
import tf2_ros
from geometry_msgs.msg import PointStamped
from rosgraph_msgs.msg import Log

import mesh_messages
import rviz_window
import stand_in_mapper

HIGHLIGHT_SHARE = 0.6  # of yellow over the class colour
YELLOW = (255, 255, 0)
CAR = mesh_messages.CLASSES[3][1]
ON_CAR, ON_ROAD = (6.8, -4.3), (3.2, 6.8)
PICTURES = os.environ.get("FACET_MAPPING_PICTURES")


def is_near(a, b, tolerance=4):
    return all(abs(x - y) <= tolerance for x, y in zip(a, b))


def highlighted(color):
    return tuple(HIGHLIGHT_SHARE * a + (1 - HIGHLIGHT_SHARE) * b for a, b in zip(YELLOW, color))


class InspectFacetTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        if rviz_window.missing():
            raise unittest.SkipTest("not installed: " + ", ".join(rviz_window.missing()))
        rospy.init_node("inspect_facet_test")
        cls.mapper = stand_in_mapper.Mapper()
        cls.window = rviz_window.RvizWindow(rosgraph.get_master_uri())
        cls.addClassCleanup(cls.window.close)
        cls.window.start()
        cls.news = threading.Condition()
        cls.points, cls.lines = [], []
        rospy.Subscriber("/clicked_facet", PointStamped, cls.take_point)
        rospy.Subscriber("/rosout", Log, cls.take_line)

    @classmethod
    def take_point(cls, message):
        with cls.news:
            cls.points.append(message)
            cls.news.notify_all()

    @classmethod
    def take_line(cls, message):
        with cls.news:
            if message.msg.startswith("Facet of "):
                cls.lines.append(message.msg)
                cls.news.notify_all()

    def show(self, properties="", chunks=None, frame="map", road=ON_ROAD):
        """Loads the configuration and waits for the mesh."""
        self.mapper.show(mesh_messages.mesh(chunks or mesh_messages.four_fields(), map_id=self.id(),
                                            frame=frame))
        self.window.load(properties)
        picture = self.window.wait_for(lambda p: is_near(p.at(*road), mesh_messages.CLASSES[0][1]))
        self.assertTrue(is_near(picture.at(*road), mesh_messages.CLASSES[0][1]))
        # Loading has made the tool anew: what it sends before we are connected would be lost.
        end = time.monotonic() + rviz_window.TIMEOUT_S
        while not self.is_tool_connected():
            self.assertLess(time.monotonic(), end, "the tool does not publish")
            time.sleep(0.1)
        self.window.press("l")
        with self.news:
            self.points.clear()
            self.lines.clear()

    def is_tool_connected(self):
        publishers = dict(rosgraph.Master("/test").getSystemState()[0])
        return publishers.get("/clicked_facet") == ["/rviz"]

    def click(self, x, y):
        """The point published and the line said, or None if nothing comes in some seconds."""
        with self.news:
            self.points.clear()
            self.lines.clear()
        self.window.click_ground(x, y)
        with self.news:
            self.news.wait_for(lambda: self.points and self.lines, 3)
            return (self.points[0], self.lines[0]) if self.points and self.lines else None

    def answer(self, x, y):
        answer = self.click(x, y) or self.click(x, y)  # the first may come before the key
        self.assertIsNotNone(answer, "no answer")
        return answer

    def picture(self, is_right):
        path = PICTURES and os.path.join(PICTURES, self.id().split(".")[-1] + ".png")
        picture = self.window.wait_for(is_right, path)
        self.assertTrue(self.window.is_alive(), "rviz has ended")
        return picture

    def test_a_known_facet(self):
        self.show()
        point, line = self.answer(*ON_CAR)
        self.assertEqual(point.header.frame_id, "map")
        for seen, there in zip((point.point.x, point.point.y, point.point.z), (*ON_CAR, 2.0)):
            self.assertAlmostEqual(seen, there, delta=0.03)  # a pixel is 0.04 m
        self.assertIn("Facet of Mesh: car (3), confidence 1.00, normal (0.00, 0.00, 1.00), "
                      "slope 0.0 deg, area 3.1250 m^2, views 10, chunk (0, -1, 0), at (6.8", line)
        self.assertTrue(line.endswith(", 2.00) m in map"), line)
        # A point of the same facet, and one of its neighbour across the diagonal.
        same, neighbour = (7.2, -4.6), (5.4, -2.8)
        picture = self.picture(lambda p: is_near(p.at(*same), highlighted(CAR)))
        self.assertTrue(is_near(picture.at(*same), highlighted(CAR)), picture.at(*same))
        self.assertTrue(is_near(picture.at(*neighbour), CAR), picture.at(*neighbour))

    def test_the_next_click_moves_the_highlight(self):
        self.show()
        self.answer(*ON_CAR)
        _, line = self.answer(*ON_ROAD)
        self.assertIn("road (0), confidence 1.00", line)
        self.assertIn("views 20, chunk (0, 0, 0)", line)
        picture = self.picture(lambda p: is_near(p.at(7.2, -4.6), CAR))
        self.assertTrue(is_near(picture.at(7.2, -4.6), CAR))

    def test_a_slope(self):
        def roof(x, _y):
            return 0.75 * x  # 36.9 degrees

        chunks = [mesh_messages.field((0, 0, 0), (0.0, 0.0, 0.0), 4, 10.0, 0, height=roof)]
        self.show(chunks=chunks)
        point, line = self.answer(*ON_ROAD)
        self.assertIn("normal (-0.60, 0.00, 0.80), slope 36.9 deg, area 3.906", line)
        self.assertAlmostEqual(point.point.z, 0.75 * ON_ROAD[0], delta=0.03)

    def test_a_mesh_in_another_frame(self):
        tf2_ros.StaticTransformBroadcaster().sendTransform(mesh_messages.turned_frame())
        self.show(frame="odom", road=mesh_messages.turned(*ON_ROAD))
        place, same = mesh_messages.turned(*ON_CAR), mesh_messages.turned(7.2, -4.6)
        point, line = self.answer(*place)
        self.assertEqual(point.header.frame_id, "odom")
        self.assertAlmostEqual(point.point.x, ON_CAR[0], delta=0.03)
        self.assertAlmostEqual(point.point.y, ON_CAR[1], delta=0.03)
        self.assertIn("car (3)", line)
        picture = self.picture(lambda p: is_near(p.at(*same), highlighted(CAR)))
        self.assertTrue(is_near(picture.at(*same), highlighted(CAR)), picture.at(*same))

    def test_the_mark_leaves_with_the_map(self):
        self.show()
        self.answer(*ON_CAR)
        self.picture(lambda p: is_near(p.at(7.2, -4.6), highlighted(CAR)))
        self.mapper.show(mesh_messages.mesh(mesh_messages.four_fields(), map_id="the next"))
        picture = self.picture(lambda p: is_near(p.at(7.2, -4.6), CAR))
        self.assertTrue(is_near(picture.at(7.2, -4.6), CAR))

    def test_what_is_hidden_is_not_hit(self):
        self.show("Classes:\n  Value: true\n  car:\n    Value: false")
        self.answer(*ON_ROAD)  # the tool is there
        self.assertIsNone(self.click(*ON_CAR))
        self.show("Cut:\n  Value: true\n  Height: 1")
        self.answer(*ON_ROAD)
        self.assertIsNone(self.click(*ON_CAR))

    def test_what_the_mesh_does_not_say(self):
        chunks = mesh_messages.four_fields()
        chunks[3].confidence, chunks[3].views, chunks[3].labels = b"", [], []
        self.show(chunks=chunks)
        _, line = self.answer(*ON_CAR)
        self.assertIn("unlabelled, confidence not known", line)
        self.assertIn("views not known", line)

    def test_beside_the_mesh_there_is_nothing(self):
        self.show()
        self.answer(*ON_ROAD)
        self.assertIsNone(self.click(12.0, 3.0))
        picture = self.picture(lambda p: True)
        self.assertTrue(is_near(picture.at(*ON_ROAD), mesh_messages.CLASSES[0][1]))


if __name__ == "__main__":
    rostest.rosrun("facet_mapping", "inspect_facet", InspectFacetTest, sys.argv)
