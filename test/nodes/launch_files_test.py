#!/usr/bin/python3
# SPDX-FileCopyrightText: facet_mapping contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Launch files: they parse, document their arguments and set only parameters that are read; the
README's parameter tables are those of the programs."""
import glob
import os
import re
import subprocess
import sys
import unittest
import xml.etree.ElementTree as ElementTree

import roslaunch.config
import roslaunch.loader
import roslaunch.xmlloader
import roslib.packages
import rospkg
import rostest

PACKAGE = "facet_mapping"
NODES = ["stereo_points", "track_points", "sweep_points", "lidar_points", "segmenter", "mapper",
         "refiner", "mesh_server"]
# Arguments without default.
NEEDED = {"inspect.launch": ["mesh:=/data/street.ply"]}
FOLDER = rospkg.RosPack().get_path(PACKAGE)
LAUNCH_FILES = sorted(glob.glob(os.path.join(FOLDER, "launch", "*.launch")))


def load(path, *arguments):
    arguments = NEEDED.get(os.path.basename(path), []) + list(arguments)
    config = roslaunch.config.ROSLaunchConfig()
    roslaunch.xmlloader.XmlLoader().load(path, config, argv=arguments, verbose=False)
    return config


def parameter_table(node):
    program = roslib.packages.find_node(PACKAGE, node)[0]
    return subprocess.run([program, "--parameters"], check=True, text=True, capture_output=True,
                          timeout=60).stdout


def documented(node):
    return set(re.findall(r"^\| `([^`]+)` \|", parameter_table(node), re.MULTILINE))


class LaunchFilesTest(unittest.TestCase):
    def test_there_are_launch_files(self):
        names = [os.path.basename(path) for path in LAUNCH_FILES]
        for name in ["custom.launch", "demo.launch", "inspect.launch", "kitti.launch"]:
            self.assertIn(name, names)

    def test_every_argument_is_documented(self):
        for path in LAUNCH_FILES:
            arguments = ElementTree.parse(path).getroot().findall("arg")
            for argument in [a for a in arguments if a.get("value") is None]:
                self.assertTrue(argument.get("doc"), "%s: %s" % (path, argument.get("name")))

    def test_every_program_exists(self):
        for path in LAUNCH_FILES:
            for node in load(path).nodes:
                if node.package != "rviz":
                    self.assertTrue(roslib.packages.find_node(node.package, node.type),
                                    "%s: %s/%s" % (path, node.package, node.type))

    def test_only_parameters_that_are_read_are_set(self):
        known = {node: documented(node) for node in NODES}
        for path in LAUNCH_FILES:
            for key in load(path).params:
                node, _, name = key.lstrip("/").partition("/")
                if node in known:
                    self.assertIn(name, known[node], path)

    def test_kitti_topics(self):
        kitti = os.path.join(FOLDER, "launch", "kitti.launch")
        config = load(kitti, "lidar:=true", "bag:=/data/drive.bag")
        self.assertEqual(config.params["/mapper/point_topics"].value,
                         ["stereo_points/points", "lidar_points/points"])
        nodes = {node.name: node for node in config.nodes}
        self.assertIn(("point_cloud", "/kitti/velo/pointcloud"),
                      [(a.strip("/"), b) for a, b in nodes["lidar_points"].remap_args])
        self.assertIn("/data/drive.bag", nodes["player"].args)
        self.assertNotIn("player", [node.name for node in load(kitti).nodes])
        self.assertEqual(load(kitti).params["/mapper/point_topics"].value,
                         ["stereo_points/points"])
        self.assertTrue(load(kitti).params["/use_sim_time"].value)

    def test_inspect_finds_the_mesh_where_it_was_called(self):
        inspect = os.path.join(FOLDER, "launch", "inspect.launch")
        self.assertEqual(load(inspect).params["/mesh_server/mesh"].value, "/data/street.ply")
        relative = load(inspect, "mesh:=street.ply").params["/mesh_server/mesh"].value
        self.assertEqual(relative, os.environ.get("PWD", "") + "/street.ply")
        self.assertEqual([n.name for n in load(inspect, "rviz:=false").nodes], ["mesh_server"])

    def test_arguments_that_mean_nothing_are_refused(self):
        custom = os.path.join(FOLDER, "launch", "custom.launch")
        for arguments, name in [(["camera:=momo"], "camera_must_be"),
                                (["camera:=none"], "lidar_must_be_true"),
                                (["segmentation:=yes"], "segmentation_must_be"),
                                (["segmentation:=forest"], "model_must_be_given"),
                                (["mono_points:=dense"], "mono_points_must_be")]:
            with self.assertRaisesRegex(roslaunch.xmlloader.XmlParseException, name):
                load(custom, *arguments)

    def test_every_overlay_sets_only_parameters_that_are_read(self):
        known = {node: documented(node) for node in NODES}
        overlays = sorted(glob.glob(os.path.join(FOLDER, "config", "datasets", "*.yaml")))
        self.assertGreaterEqual(len(overlays), 6)
        for overlay in overlays:
            for rig in [["camera:=mono", "mono_points:=both", "lidar:=true"], ["camera:=stereo"]]:
                config = load(os.path.join(FOLDER, "launch", "custom.launch"), "overlay:=" + overlay,
                              *rig)
                for key in config.params:
                    node, _, name = key.lstrip("/").partition("/")
                    if node in known:
                        self.assertIn(name, known[node], overlay)

    def test_a_namespace_around_is_followed(self):
        path = os.path.join(FOLDER, "launch", "custom.launch")
        config = roslaunch.config.ROSLaunchConfig()
        loader = roslaunch.xmlloader.XmlLoader()
        text = '<launch><group ns="car"><include file="%s"/></group></launch>' % path
        loader.load_string(text, config, verbose=False)
        self.assertIn("/car/mapper/map_frame", config.params)

    def test_readme_tables_are_those_of_the_programs(self):
        with open(os.path.join(FOLDER, "README.md"), encoding="utf-8") as file:
            readme = file.read()
        for node in NODES:
            marked = re.search(r"<!-- parameters %s -->\n(.*?)<!-- end -->" % node, readme, re.DOTALL)
            if marked is None:
                self.skipTest("README.md has no table between '<!-- parameters %s -->' and "
                              "'<!-- end -->'" % node)
            self.assertEqual(marked.group(1).strip(), parameter_table(node).strip(),
                             "paste the output of: rosrun facet_mapping %s --parameters" % node)


if __name__ == "__main__":
    rostest.rosrun(PACKAGE, "launch_files", LaunchFilesTest, sys.argv)
