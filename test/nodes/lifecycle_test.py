#!/usr/bin/python3
# SPDX-FileCopyrightText: facet_mapping contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""How nodes begin and end: bad parameters, SIGINT, nodelets."""
import signal
import subprocess
import sys
import unittest

import roslib.packages
import rosgraph
import rospy
import rosservice
import rostest

PACKAGE = "facet_mapping"
NODES = ["stereo_points", "track_points", "sweep_points", "lidar_points", "mapper", "refiner",
         "mesh_server"]
NODELETS = {"stereo_points": "StereoPoints", "track_points": "TrackPoints",
            "sweep_points": "SweepPoints", "lidar_points": "LidarPoints",
            "mapper": "Mapper", "refiner": "Refiner", "mesh_server": "MeshServer"}
# Far more than a node needs, so that a slow machine does not fail the test.
TIMEOUT_S = 30


def program(node):
    return roslib.packages.find_node(PACKAGE, node)[0]


def start(node, name, *arguments):
    return subprocess.Popen([program(node), "__name:=" + name, *arguments],
                            stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)


def wait_for_service(name):
    rospy.wait_for_service(name, timeout=TIMEOUT_S)


class LifecycleTest(unittest.TestCase):
    def test_all_bad_parameters_are_reported_and_the_node_ends(self):
        for node in NODES:
            name = "bad_" + node
            rospy.set_param("/" + name, {"lable_file": "x", "label_file": "no_such_list",
                                         "diagnostic_period": 0.5})
            process = start(node, name)
            output, _ = process.communicate(timeout=TIMEOUT_S)
            self.assertEqual(process.returncode, 1, output)
            self.assertIn("did you mean 'label_file'", output)
            self.assertIn("no shipped class list", output)
            self.assertIn("cityscapes", output)

    def test_sigint_ends_the_node_and_its_registrations(self):
        for node in NODES:
            name = "short_lived_" + node
            process = start(node, name)
            wait_for_service("/%s/get_loggers" % name)
            process.send_signal(signal.SIGINT)
            output, _ = process.communicate(timeout=TIMEOUT_S)
            self.assertEqual(process.returncode, 0, output)
            self.assertNotIn("unfinished", output)
            services = rosservice.get_service_list()
            self.assertFalse([s for s in services if s.startswith("/" + name + "/")])
            publishers = rosgraph.Master("/test").getSystemState()[0]
            self.assertFalse([t for t, nodes in publishers if "/" + name in nodes])

    def test_documented_parameters_are_printed(self):
        for node in NODES:
            table = subprocess.run([program(node), "--parameters"], check=True, text=True,
                                   capture_output=True, timeout=TIMEOUT_S).stdout
            # A mesh brings its own class list.
            default = "" if node == "mesh_server" else "cityscapes"
            self.assertRegex(table, r"\| `label_file` \| string \| `?%s`? \|" % default)

    def test_nodelets_load_into_one_manager(self):
        commands = [["manager", "__name:=manager"]]
        commands += [["load", "%s/%s" % (PACKAGE, NODELETS[node]), "manager", "__name:=let_" + node]
                     for node in NODES]
        nodelet = roslib.packages.find_node("nodelet", "nodelet")[0]
        processes = [subprocess.Popen([nodelet] + c, stdout=subprocess.DEVNULL) for c in commands]
        try:
            wait_for_service("/let_mapper/get_mesh")
            wait_for_service("/let_refiner/refine")
            wait_for_service("/let_mesh_server/load_mesh")
            topics = lambda: [t for t, _ in rospy.get_published_topics()]
            deadline = rospy.get_time() + TIMEOUT_S
            while "/points" not in topics() and rospy.get_time() < deadline:
                rospy.sleep(0.1)
            self.assertIn("/points", topics())
            self.assertIn("/let_mapper/mesh", topics())
        finally:
            for process in reversed(processes):
                process.send_signal(signal.SIGINT)
            for process in processes:
                process.wait(timeout=TIMEOUT_S)

    def test_nodelet_with_bad_parameters_leaves_the_manager_alive(self):
        rospy.set_param("/let_bad", {"tf_timeout": 1.0})
        nodelet = roslib.packages.find_node("nodelet", "nodelet")[0]
        manager = subprocess.Popen([nodelet, "manager", "__name:=other_manager"],
                                   stdout=subprocess.DEVNULL)
        load = subprocess.Popen([nodelet, "load", PACKAGE + "/Mapper", "other_manager",
                                 "__name:=let_bad"], stdout=subprocess.DEVNULL)
        good = None
        try:
            wait_for_service("/other_manager/list")
            good = subprocess.Popen([nodelet, "load", PACKAGE + "/Mapper", "other_manager",
                                     "__name:=let_good"], stdout=subprocess.DEVNULL)
            wait_for_service("/let_good/get_mesh")
            self.assertIsNone(manager.poll())
        finally:
            for process in filter(None, [good, load, manager]):
                process.send_signal(signal.SIGINT)
                process.wait(timeout=TIMEOUT_S)


if __name__ == "__main__":
    rospy.init_node("lifecycle_test")
    rostest.rosrun(PACKAGE, "lifecycle", LifecycleTest, sys.argv)
