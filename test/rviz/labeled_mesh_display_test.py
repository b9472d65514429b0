#!/usr/bin/python3
# SPDX-FileCopyrightText: facet_mapping contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The display in a real rviz: the colours of named pixels. With FACET_MAPPING_PICTURES=FOLDER the
pictures are kept."""
import os
import sys
import time
import unittest

import rosgraph
import rospy
import rostest
import tf2_ros
from geometry_msgs.msg import PointStamped

import mesh_messages
import rviz_window
import stand_in_mapper

BACKGROUND = (32, 36, 40)
# A point in each field, by class; none on an edge of a facet.
POINTS = {0: (3.2, 6.8), 1: (-6.8, 4.3), 2: (-4.3, -5.7), 3: (6.8, -4.3)}
COLORS = {number: rgb for number, (_, rgb) in mesh_messages.CLASSES.items()}
TOLERANCE = 3  # of 255: rounding on the way through the graphics library
RAMP_LOW, RAMP_HIGH = (40, 30, 110), (250, 230, 40)
STATUS_COLORS = {"fine": (40, 120, 197), "warning": (192, 128, 0), "error": (192, 32, 32)}
PICTURES = os.environ.get("FACET_MAPPING_PICTURES")


def is_near(a, b):
    return all(abs(x - y) <= TOLERANCE for x, y in zip(a, b))


class LabeledMeshDisplayTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        if rviz_window.missing():
            raise unittest.SkipTest("not installed: " + ", ".join(rviz_window.missing()))
        rospy.init_node("labeled_mesh_display_test")
        cls.mapper = stand_in_mapper.Mapper()
        cls.window = rviz_window.RvizWindow(rosgraph.get_master_uri())
        cls.addClassCleanup(cls.window.close)
        cls.window.start()

    def setUp(self):
        self.mapper.show(mesh_messages.mesh(mesh_messages.four_fields(), map_id=self.id()))

    def expect(self, colors):
        """`colors`: by class whose field is looked at, what is to be seen there."""
        def is_right(picture):
            return all(is_near(picture.at(*POINTS[k]), color) for k, color in colors.items())

        path = PICTURES and os.path.join(PICTURES, self.id().split(".")[-1] + ".png")
        picture = self.window.wait_for(is_right, path)
        self.assertTrue(self.window.is_alive(), "rviz has ended")
        for number, color in colors.items():
            seen = picture.at(*POINTS[number])
            self.assertTrue(is_near(seen, color), "class %d: %s, not %s" % (number, seen, color))

    def test_class_colors(self):
        self.window.load()
        self.expect(COLORS)

    def test_a_class_switched_off(self):
        self.window.load("Classes:\n  Value: true\n  building:\n    Value: false")
        self.expect({**COLORS, 1: BACKGROUND})

    def test_a_class_recolored_and_translucent(self):
        self.window.load("Classes:\n  Value: true\n  road:\n    Color: 10; 200; 30\n    Value: true\n"
                         "  car:\n    Alpha: 0.5\n    Value: true")
        half = tuple((a + b) / 2 for a, b in zip(COLORS[3], BACKGROUND))
        self.expect({**COLORS, 0: (10, 200, 30), 3: half})

    def test_a_palette_that_comes_late_gives_colors_but_keeps_what_was_chosen(self):
        self.mapper.hide_palette()
        self.window.load("Classes:\n  Value: true\n  road:\n    Color: 10; 200; 30\n    Value: true\n"
                         "  car:\n    Alpha: 0.5\n    Value: true")
        unknown = (255, 0, 255)
        self.expect({0: unknown, 1: unknown, 3: unknown})
        self.mapper.show_palette()
        half = tuple((a + b) / 2 for a, b in zip(COLORS[3], BACKGROUND))
        self.expect({**COLORS, 0: (10, 200, 30), 3: half})

    def test_confidence(self):
        self.window.load("Color Mode: confidence")
        self.expect({0: RAMP_HIGH, 1: (44, 78, 150), 2: RAMP_HIGH, 3: RAMP_HIGH})

    def test_normal(self):
        self.window.load("Color Mode: normal")
        self.expect({k: (128, 128, 255) for k in COLORS})

    def test_height(self):
        self.window.load("Color Mode: height")
        self.expect({0: RAMP_LOW, 1: RAMP_LOW, 2: RAMP_LOW, 3: RAMP_HIGH})

    def test_views(self):
        self.window.load("Color Mode: views")
        self.expect({0: RAMP_HIGH, 1: (45, 90, 160), 2: RAMP_LOW, 3: (30, 150, 135)})

    def test_chunk(self):
        self.window.load("Color Mode: chunk")
        others = set(COLORS.values()) | {BACKGROUND}

        def is_right(picture):
            seen = {picture.at(*POINTS[k]) for k in COLORS}
            return len(seen) == 4 and not seen & others

        path = PICTURES and os.path.join(PICTURES, "test_chunk.png")
        self.assertTrue(is_right(self.window.wait_for(is_right, path)))

    def test_flat(self):
        self.window.load("Color Mode:\n  Value: flat\n  Color: 12; 34; 200")
        self.expect({k: (12, 34, 200) for k in COLORS})

    def test_limits(self):
        self.window.load("Min Confidence: 0.5\nCut:\n  Value: true\n  Height: 1")
        self.expect({**COLORS, 1: BACKGROUND, 3: BACKGROUND})

    def test_unseen_facets_are_left_out_unless_wanted(self):
        self.window.load("Unseen Facets: false")
        self.expect({**COLORS, 2: BACKGROUND})

    def expect_edge(self, color):
        """Along the edge of facets at x = 2.5 m, within the first field."""
        def is_there(picture):
            column, row = self.window.view.pixel_of(2.5, POINTS[0][1])
            return any(is_near(picture.pixel(column + k, row), color) for k in range(-2, 3))

        self.assertTrue(is_there(self.window.wait_for(is_there)), "no such edge")

    def test_wireframe_leaves_the_middle_free(self):
        self.window.load("Style: wireframe")
        self.expect_edge(COLORS[0])
        self.expect({k: BACKGROUND for k in COLORS})

    def test_edges_over_faces(self):
        self.window.load("Style: both")
        self.expect_edge(tuple(0.35 * value for value in COLORS[0]))
        self.expect(COLORS)

    def boxes(self):
        """Rows on the screen of what is dark where the tree has its check boxes, the values of
        other properties among it; once the tree has come to rest."""
        rows = []
        end = time.monotonic() + rviz_window.TIMEOUT_S
        while time.monotonic() < end:
            picture = self.window.picture()
            dark = [row for row in range(90, 485)
                    if any(sum(picture.pixel(column, row)) < 150 for column in range(178, 185))]
            before, rows = rows, [row + 3 for row in dark if row - 1 not in dark]
            if rows == before:
                break
            time.sleep(1)
        self.assertGreater(len(rows), 5)
        return rows

    def test_the_box_of_a_class_switches_it_off_and_on(self):
        self.window.load("Classes:\n  Value: true\n  building:\n    Value: false")
        shown = {**COLORS, 1: BACKGROUND}  # unlike what was shown before
        self.expect(shown)
        _, road, _, car = self.boxes()[-4:]  # the empty box of the buildings is not dark
        calls = self.mapper.calls
        self.window.click(181, road)
        self.expect({**shown, 0: BACKGROUND})
        self.window.click(181, car)
        self.expect({**shown, 0: BACKGROUND, 3: BACKGROUND})
        self.window.click(181, road)
        self.expect({**shown, 3: BACKGROUND})
        self.assertEqual(self.mapper.calls, calls)

    def test_a_mesh_in_another_frame(self):
        tf2_ros.StaticTransformBroadcaster().sendTransform(mesh_messages.turned_frame())
        self.mapper.show(mesh_messages.mesh(mesh_messages.four_fields(), map_id="turned",
                                            frame="odom"))
        self.window.load("Color Mode:\n  Value: class\n  Auto Height: true")

        def is_right(picture):
            return all(is_near(picture.at(*mesh_messages.turned(*POINTS[k])), COLORS[k])
                       for k in COLORS)

        self.assertTrue(is_right(self.window.wait_for(is_right)))

    def expect_status(self, color):
        """Of the rows with the display's name and its status in the tree."""
        def is_right(picture):
            shown = {kind for kind, rgb in STATUS_COLORS.items()
                     if any(is_near(picture.pixel(column, row), rgb)
                            for row in range(123, 162) for column in range(40, 170))}
            return shown == {color}

        path = PICTURES and os.path.join(PICTURES, self.id().split(".")[-1] + ".png")
        self.assertTrue(is_right(self.window.wait_for(is_right, path)), "status not " + color)

    def test_the_status_says_that_nobody_publishes(self):
        self.window.topic = "/nowhere/mesh"
        self.addCleanup(setattr, self.window, "topic", "/mapper/mesh")
        self.window.load()
        self.expect_status("warning")

    def test_the_status_says_that_the_frame_is_unknown(self):
        self.mapper.show(mesh_messages.mesh(mesh_messages.four_fields(), map_id="far",
                                            frame="moon"))
        self.window.load()
        self.expect_status("error")
        self.mapper.show(mesh_messages.mesh(mesh_messages.four_fields(), map_id="here"))
        self.expect_status("fine")

    def shipped(self, name, topic):
        """A configuration of the package, with the stand-in's mesh in plain colours."""
        text = (rviz_window.HERE.parents[1] / "config/rviz" / name).read_text(encoding="utf-8")
        self.assertIn("Topic: %s\n" % topic, text)
        text = text.replace("Topic: %s\n" % topic,
                            "Topic: /mapper/mesh\n      Lighting: false\n", 1)
        text = text.replace("Fixed Frame: inspect", "Fixed Frame: map")
        return self.window.write_file(text)

    def test_shipped_configurations_in_perspective(self):
        for name, topic in (("inspect.rviz", "/mesh_server/mesh"),
                            ("mapping.rviz", "/mapper/mesh")):
            self.window.load_file(self.shipped(name, topic))

            def has_all(picture):
                counts = {k: picture.count(color) for k, color in COLORS.items()}
                return counts[2] == 0 and all(counts[k] > 300 for k in (0, 1, 3))

            path = PICTURES and os.path.join(PICTURES, name + ".png")
            picture = self.window.wait_for(has_all, path)
            self.assertTrue(self.window.is_alive(), "rviz has ended")
            self.assertTrue(has_all(picture), name)

    def test_two_displays_of_one_topic(self):
        path = self.window.write_config("Alpha: 0")
        with open(path, encoding="utf-8") as file:
            text = file.read()
        second = ("    - Class: facet_mapping/LabeledMesh\n      Name: Second\n      Enabled: false\n"
                  "      Topic: /mapper/mesh\n      Lighting: false\n      Unseen Facets: true\n")
        with open(path, "w", encoding="utf-8") as file:
            file.write(text.replace("  Tools:\n", second + "  Tools:\n"))
        self.window.load_file(path)
        self.expect({k: BACKGROUND for k in COLORS})  # what was shown before has gone
        end = time.monotonic() + rviz_window.TIMEOUT_S
        while not self.is_seen(COLORS, 6) and time.monotonic() < end:
            boxes = self.boxes()  # by now the first has the mesh, and the connection
            self.window.click(181, 2 * boxes[-1] - boxes[-2])  # the next row, its box empty
        self.expect(COLORS)

    def is_seen(self, colors, patience_s):
        end = time.monotonic() + patience_s
        while time.monotonic() < end:
            picture = self.window.picture()
            if all(is_near(picture.at(*POINTS[k]), color) for k, color in colors.items()):
                return True
            time.sleep(0.3)
        return False

    def test_what_rvizs_own_tools_hit(self):
        points = []
        subscriber = rospy.Subscriber("/clicked_point", PointStamped, points.append)
        self.addCleanup(subscriber.unregister)
        self.window.load("Classes:\n  Value: true\n  building:\n    Value: false")
        self.expect({**COLORS, 1: BACKGROUND})
        for number, height in ((3, 2.0), (0, 0.0)):
            self.click_point(points, *POINTS[number])
            self.assertEqual(len(points), 1)
            seen = points[0].point
            for value, expected in zip((seen.x, seen.y, seen.z), (*POINTS[number], height)):
                self.assertAlmostEqual(value, expected, delta=0.1)
        self.click_point(points, *POINTS[1], patience_s=4)
        self.assertEqual(points, [], "hit what is hidden")

    def click_point(self, points, x, y, patience_s=rviz_window.TIMEOUT_S):
        """With the tool PublishPoint, which ends with the point."""
        points.clear()
        end = time.monotonic() + patience_s
        while not points and time.monotonic() < end:
            self.window.press("c")  # again, since a point sent before we are connected is lost
            time.sleep(0.3)
            self.window.click_ground(x, y)
            time.sleep(0.7)

    def test_a_delta_changes_one_chunk_and_removes_another(self):
        self.window.load()
        self.expect(COLORS)
        changed = mesh_messages.field((0, 0, 0), (0.0, 0.0, 0.0), 4, 10.0, 3)
        changed.revision = 2
        delta = mesh_messages.mesh([changed], 2, False, self.id())
        delta.removed_keys = [-1, -1, 0]
        self.mapper.show(delta, self.mapper.full)
        self.expect({**COLORS, 0: COLORS[3], 2: BACKGROUND})

    def test_after_a_lost_message_get_mesh_is_asked(self):
        self.window.load()
        self.expect(COLORS)
        calls = self.mapper.calls
        now = [mesh_messages.field((0, 0, 0), (0.0, 0.0, 0.0), 4, 10.0, 2)]
        now[0].revision = 3
        delta = mesh_messages.mesh([], 5, False, self.id())
        self.mapper.show(delta, mesh_messages.mesh(now, 5, True, self.id()))
        self.expect({0: COLORS[2], 1: BACKGROUND, 2: BACKGROUND, 3: BACKGROUND})
        self.assertEqual(self.mapper.calls, calls + 1)

    def test_reset(self):
        self.window.load()
        self.expect(COLORS)
        self.mapper.show(mesh_messages.mesh([], 0, True, "after the reset"))
        self.expect({k: BACKGROUND for k in COLORS})

    def test_what_a_broken_publisher_sends(self):
        self.window.load()
        bad = mesh_messages.four_fields()
        for vertex in bad[0].vertices:
            vertex.z = float("nan")
        bad[1].triangles = [900000 + k for k in range(len(bad[1].triangles))]
        bad[2].labels = bad[2].labels[:-1]
        bad[3].labels = [77] * len(bad[3].labels)
        self.mapper.show(mesh_messages.mesh(bad, map_id="broken"))
        self.expect({0: BACKGROUND, 1: BACKGROUND, 2: (128, 128, 128), 3: (255, 0, 255)})

    def test_rviz_restarted(self):
        self.window.stop()
        self.window.start()
        self.expect(COLORS)


if __name__ == "__main__":
    rostest.rosrun("facet_mapping", "labeled_mesh_display", LabeledMeshDisplayTest, sys.argv)
