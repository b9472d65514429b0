#!/usr/bin/python3
# SPDX-FileCopyrightText: facet_mapping contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The panel in a real rviz beside the real nodes, which have mapped a few metres of the synthetic
street. With FACET_MAPPING_PICTURES=FOLDER the pictures are kept."""
import os
import sys
import time
import unittest

import rosgraph
import rospy
import rostest
from facet_mapping.msg import LabeledMesh, RefineProgress

import rviz_window
import street_drive
from refine_window import (ANSWER, PLOT, RefineWindow, bar_length, is_good, is_photometric,
                           is_semantic, is_stopped, like)

PICTURES = os.environ.get("FACET_MAPPING_PICTURES")
FRAMES = 12
VIEW = "Scale: 25\nX: 8\nY: 0"  # the first part of the street, from its start
TIMEOUT_S = 120  # far more than needed, so that a slow machine does not fail the test


class RefineStreetTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        if rviz_window.missing():
            raise unittest.SkipTest("not installed: " + ", ".join(rviz_window.missing()))
        rospy.init_node("refine_street_test")
        cls.refined = []
        cls.progress = []
        cls.subscribers = [
            rospy.Subscriber("/refiner/mesh", LabeledMesh, cls.refined.append),
            rospy.Subscriber("/refiner/progress", RefineProgress, cls.progress.append)]
        cls.window = RefineWindow(rosgraph.get_master_uri())
        cls.addClassCleanup(cls.window.close)
        cls.window.view_lines = VIEW
        cls.window.start()
        drive = street_drive.StreetDrive(FRAMES)
        drive.wait_for_nodes({"/refiner": street_drive.LEFT + street_drive.TRANSFORMS})
        drive.drive_on(FRAMES)

    def wait_for(self, is_right, name):
        path = PICTURES and os.path.join(PICTURES, "street_" + name + ".png")
        end = time.monotonic() + TIMEOUT_S
        while not is_right(self.window.picture(path)):
            self.assertTrue(self.window.is_alive(), "rviz has ended")
            self.assertLess(time.monotonic(), end, name + " not seen")
            time.sleep(0.3)

    def start(self, panel):
        self.window.load_panel(panel, VIEW)
        count = len(self.progress)
        end = time.monotonic() + TIMEOUT_S
        while len(self.progress) == count:
            self.assertLess(time.monotonic(), end, "no progress")
            self.window.shortcut("r")
            time.sleep(1)

    def test_the_visible_part_is_refined(self):
        self.start("Region: what the view shows\nLevels: 1\nIterations: 4")
        self.wait_for(lambda p: bar_length(p) > 20 and like(p, is_photometric, rows=PLOT)
                      and like(p, is_semantic, rows=PLOT), "during")
        self.wait_for(lambda p: like(p, is_good, rows=ANSWER), "after")
        energies = [sample.energy.photometric for sample in self.progress]
        self.assertLess(energies[-1], energies[0])
        self.assertTrue(self.refined)

    def test_what_runs_is_cancelled(self):
        self.start("Levels: 1\nIterations: 500")

        def is_cancelled(picture):
            if not like(picture, is_stopped, rows=ANSWER):
                self.window.shortcut("c")
                return False
            return True

        self.wait_for(is_cancelled, "cancelled")
        self.assertLess(self.progress[-1].fraction, 1.0)


if __name__ == "__main__":
    rostest.rosrun("facet_mapping", "refine_street", RefineStreetTest, sys.argv)
