#!/usr/bin/python3
# SPDX-FileCopyrightText: facet_mapping contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The panel in a real rviz beside a stand-in for the refiner. With FACET_MAPPING_PICTURES=FOLDER the
pictures are kept."""
import os
import pathlib
import queue
import subprocess
import sys
import time
import unittest

import rosgraph
import rospy
import rostest
from facet_mapping.msg import ClassPalette, LabeledMesh, Status
from facet_mapping.srv import RefineRequest, RefineResponse

import mesh_messages
import refine_node
import rviz_window
from refine_window import (ANSWER, PLOT, RefineWindow, bar_length, is_bad, is_good, is_near,
                           is_photometric, is_semantic, like)

PICTURES = os.environ.get("FACET_MAPPING_PICTURES")
TIMEOUT_S = rviz_window.TIMEOUT_S
VIEW = {"columns": range(400, 1280, 8), "rows": range(0, 800, 8)}
ROAD, VEGETATION = (mesh_messages.CLASSES[number][1] for number in (0, 2))
REGION_MARGIN_M = 0.01


class RefinePanelTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        if rviz_window.missing():
            raise unittest.SkipTest("not installed: " + ", ".join(rviz_window.missing()))
        rospy.init_node("refine_panel_test")
        cls.palette = rospy.Publisher("/mapper/palette", ClassPalette, latch=True, queue_size=1)
        cls.palette.publish(mesh_messages.palette())
        cls.mesh = rospy.Publisher("/mapper/mesh", LabeledMesh, latch=True, queue_size=1)
        cls.mesh.publish(mesh_messages.mesh(mesh_messages.four_fields()))
        cls.node = refine_node.RefineNode("/refiner")
        cls.addClassCleanup(cls.node.may_answer.set)
        cls.window = RefineWindow(rosgraph.get_master_uri())
        cls.addClassCleanup(cls.window.close)
        cls.window.start()

    def setUp(self):
        self.node.begin()

    def wait_for(self, is_right, name="", message="not seen"):
        path = PICTURES and os.path.join(PICTURES, self.id().split(".")[-1] + name + ".png")
        picture = self.window.wait_for(is_right, path)
        self.assertTrue(self.window.is_alive(), "rviz has ended")
        self.assertTrue(is_right(picture), message)
        return picture

    def reach(self, letter, kept):
        """Presses the button until the node has got the call: it is enabled when it makes sense."""
        end = time.monotonic() + TIMEOUT_S
        while time.monotonic() < end:
            self.window.shortcut(letter)
            try:
                return kept.get(timeout=2)
            except queue.Empty:
                self.assertTrue(self.window.is_alive(), "rviz has ended")
        return self.fail("the call of Alt+%s did not arrive" % letter)

    def refine(self):
        return self.reach("r", self.node.asked)

    def expect_no_request(self):
        self.window.shortcut("r")
        with self.assertRaises(queue.Empty):
            self.node.asked.get(timeout=2)

    def wait_until_shown(self):
        """The four fields."""
        self.wait_for(lambda p: like(p, is_near(VEGETATION), **VIEW), "_mesh", "no mesh shown")

    def test_what_is_not_chosen_is_left_to_the_node(self):
        self.window.load_panel()
        request = self.refine()
        expected = RefineRequest(semantic_weight=-1, smoothing=-1, thin_plate=-1)
        self.assertEqual(request, expected)

    def test_dry_run(self):
        self.window.load_panel()
        request = self.reach("d", self.node.asked)
        self.assertTrue(request.dry_run)
        self.assertEqual(self.node.asked.qsize(), 0)

    def test_chosen_terms_arrive_and_are_saved(self):
        self.window.load_panel()
        self.wait_until_shown()
        self.window.fill("l", "car, 1")
        self.window.shortcut("a")
        self.window.type("what")
        self.window.shortcut("o")
        self.window.type("of")
        self.window.shortcut("m")
        self.window.type("sp")
        for letter, text in {"v": "3", "i": "7", "w": "0.5", "t": "0.25", "b": "12.5"}.items():
            self.window.fill(letter, text)
        request = self.refine()
        self.assertEqual(request, RefineRequest(
            classes=[3, 1], start=RefineRequest.START_REFINED, photometric=RefineRequest.OFF,
            semantic_mode=RefineRequest.SEMANTIC_SPLIT, levels=3, iterations=7,
            custom_weights=True, semantic_weight=0.5, smoothing=0.25, thin_plate=-1,
            time_budget=12.5))
        self.window.shortcut("s", "Control_L")
        self.expect_saved(["Semantic: split", "Levels: 3", "Classes: car, 1", "Node: /refiner"])

    def expect_saved(self, lines):
        def missing():
            text = pathlib.Path(self.window.config_path()).read_text(encoding="utf-8")
            return [line for line in lines if line not in text]

        end = time.monotonic() + TIMEOUT_S
        while missing() and time.monotonic() < end:
            time.sleep(0.3)
        self.assertEqual(missing(), [])

    def test_saved_settings_are_loaded(self):
        self.window.load_panel(panel="Start from: what was refined\nPhotometric: on\nIterations: 9")
        request = self.refine()
        self.assertEqual((request.start, request.photometric, request.iterations),
                         (RefineRequest.START_REFINED, RefineRequest.ON, 9))

    def expect_region(self, request, low, high):
        region = request.region
        self.assertEqual(region.frame_id, "map")
        for seen, wanted in zip((region.min, region.max), (low, high)):
            for axis, value in zip("xyz", wanted):
                self.assertAlmostEqual(getattr(seen, axis), value, delta=REGION_MARGIN_M)

    def test_the_visible_region_is_that_of_the_view(self):
        everything = "Region: what the view shows"
        self.window.load_panel(panel=everything, view="Scale: 25")
        self.wait_until_shown()
        self.expect_region(self.refine(), (-10, -10, 0), (10, 10, 2))
        # 894 by 708 pixels: from 0.5 m to 15.5 m and from 2 m to 14 m.
        self.window.load_panel(panel=everything, view="Scale: 60\nX: 8\nY: 8")
        self.wait_for(lambda p: like(p, is_near(ROAD), **VIEW))
        self.expect_region(self.refine(), (0, 0, 0), (10, 10, 0))

    def test_an_empty_view_is_said_and_nothing_asked_for(self):
        self.window.load_panel(panel="Region: what the view shows", view="X: 500")
        time.sleep(3)  # the node would be there by then
        self.expect_no_request()
        self.wait_for(lambda p: like(p, is_bad, rows=ANSWER))

    def test_what_is_no_number_is_said_and_nothing_asked_for(self):
        self.window.load_panel(panel="Levels: many")
        time.sleep(3)
        self.expect_no_request()
        self.wait_for(lambda p: like(p, is_bad, rows=ANSWER))

    def test_progress_and_energies(self):
        self.window.load_panel()
        self.node.may_answer.clear()
        self.refine()
        empty = self.window.picture()
        self.node.tell(1, 0, 0.25, 0.35, 0.012)
        quarter = self.wait_for(lambda p: 50 < bar_length(p) < 120, "_quarter")
        self.node.tell(1, 1, 0.5, 0.30, 0.006)
        self.node.tell(0, 0, 0.75, 0.34, 0.010)
        most = self.wait_for(lambda p: bar_length(p) > 200, "_most")
        self.assertAlmostEqual(bar_length(most) / bar_length(quarter), 3.0, delta=0.3)
        for is_curve in (is_photometric, is_semantic):
            curve = self.curve(most, empty, is_curve)
            self.assertGreater(len(curve), 30)
            first, last = min(curve), max(curve)
            before_gap, after_gap = max(zip(curve, curve[1:]), key=lambda p: p[1][0] - p[0][0])
            self.assertLess(first[1] + 20, before_gap[1], "the energy sinks within the first level")
            self.assertAlmostEqual(after_gap[0] - before_gap[0], before_gap[0] - first[0], delta=8,
                                   msg="no line leads from one level to the next")
            self.assertLess(last[0] - after_gap[0], 8, "of the second level there is but a dot")
        self.node.answer = self.done()
        self.node.may_answer.set()
        self.wait_for(lambda p: like(p, is_good, rows=ANSWER) and bar_length(p) > 300, "_done")

    @staticmethod
    def curve(picture, empty, is_curve):
        """What has come: the words in the same colour were there before."""
        return sorted(like(picture, is_curve, rows=PLOT) - like(empty, is_curve, rows=PLOT))

    @staticmethod
    def done():
        response = RefineResponse(facets_before=800, facets_after=1200, relabelled=17, views=12,
                                  seconds=33.3, peak_memory=120)
        response.before.photometric, response.after.photometric = 0.4, 0.3
        response.before.semantic, response.after.semantic = 0.012, 0.004
        response.status.message = ("photometric 0.4 -> 0.3, semantic 0.012 -> 0.004, 1200 facets, "
                                   "33.3 s; the mesh is on ~mesh")
        return response

    def test_rviz_goes_on_during_a_call(self):
        self.window.load_panel()
        self.wait_until_shown()
        self.node.may_answer.clear()
        self.refine()
        changed = mesh_messages.four_fields()
        changed[2].labels = [1] * len(changed[2].labels)
        self.mesh.publish(mesh_messages.mesh(changed, map_id="during the call"))
        self.wait_for(lambda p: not like(p, is_near(VEGETATION), **VIEW))
        self.mesh.publish(mesh_messages.mesh(mesh_messages.four_fields(), map_id="afterwards"))

    def test_cancel_reaches_the_node(self):
        self.window.load_panel()
        self.node.may_answer.clear()
        self.refine()
        self.reach("c", self.node.cancelled)
        self.node.answer.status.code = Status.CANCELLED
        self.node.answer.status.message = "cancelled, best so far: nothing"
        self.node.may_answer.set()
        self.refine()

    def test_what_the_node_refuses_is_shown(self):
        self.window.load_panel()
        for code, sentence in ((Status.BUSY, "~refine is running; wait for it or call "
                                "~cancel_refine first"),
                               (Status.NOT_READY, "there is no mesh yet: it comes from the mapper "
                                "on '/mapper/mesh' " + 30 * "and so on ")):
            self.node.answer.status.code, self.node.answer.status.message = code, sentence
            self.refine()
            self.wait_for(lambda p: like(p, is_bad, rows=ANSWER), "_%d" % code)
        self.node.begin()
        self.refine()
        self.wait_for(lambda p: like(p, is_good, rows=ANSWER)
                      and not like(p, is_bad, rows=ANSWER))

    def test_save_mesh(self):
        self.window.load_panel(panel="Save to: ~/a folder/street.ply")
        request = self.reach("s", self.node.saved)
        self.assertEqual((request.path, list(request.classes)), ("~/a folder/street.ply", []))
        self.wait_for(lambda p: like(p, is_good, rows=ANSWER))

    def test_a_node_that_is_not_there_and_then_another(self):
        self.window.load_panel(panel="Node: /nobody")
        self.wait_for(lambda p: like(p, is_bad, rows=range(0, 200)))
        self.expect_no_request()
        self.window.fill("n", "no name")
        self.window.press("Return")
        self.expect_no_request()
        self.assertTrue(like(self.window.picture(), is_bad, rows=range(0, 200)))
        self.window.fill("n", "refiner")
        self.window.press("Return")
        self.refine()
        self.wait_for(lambda p: not like(p, is_bad))

    def test_a_job_started_elsewhere_is_shown_and_can_be_cancelled(self):
        self.window.load_panel()
        self.wait_for(lambda p: bar_length(p) < 20)
        empty = self.window.picture()

        def is_plotted(picture):
            self.node.tell(0, 1, 0.5, 0.30, 0.006)  # the panel may not have subscribed yet
            self.node.tell(0, 3, 0.75, 0.29, 0.005)
            return len(self.curve(picture, empty, is_photometric)) > 30

        self.wait_for(is_plotted)
        self.reach("c", self.node.cancelled)

    def test_a_node_killed_during_the_call(self):
        doomed = subprocess.Popen([sys.executable, refine_node.__file__, "/doomed"],
                                  stdout=subprocess.PIPE, text=True)
        self.addCleanup(doomed.stdout.close)
        self.addCleanup(doomed.wait)
        self.addCleanup(doomed.kill)
        self.assertEqual(doomed.stdout.readline(), "there\n")
        self.window.load_panel(panel="Node: /doomed")
        time.sleep(3)
        self.window.shortcut("r")
        self.assertEqual(doomed.stdout.readline(), "asked\n")
        doomed.kill()
        self.wait_for(lambda p: like(p, is_bad, rows=ANSWER))

    def test_the_panel_is_deleted_during_a_call(self):
        self.window.load_panel()
        self.node.may_answer.clear()
        self.refine()
        begin = time.monotonic()
        self.window.load_panel()  # all panels are made anew
        self.assertLess(time.monotonic() - begin, TIMEOUT_S / 2)
        self.refine()  # the first one still waits in the node
        self.assertTrue(self.window.is_alive())

    def test_rviz_is_closed_during_a_call(self):
        self.window.load_panel()
        self.node.may_answer.clear()
        self.refine()
        self.window.shortcut("q", "Control_L")
        self.assertEqual(self.window.rviz.wait(timeout=TIMEOUT_S), 0)
        self.window.start()


if __name__ == "__main__":
    rostest.rosrun("facet_mapping", "refine_panel", RefinePanelTest, sys.argv)
