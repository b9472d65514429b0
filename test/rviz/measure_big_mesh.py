#!/usr/bin/python3
# SPDX-FileCopyrightText: facet_mapping contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Time from publishing to seeing all of a big mesh, and rviz's memory: measure_big_mesh.py
(mesh|marker) CELLS [PICTURE]. Needs a ROS master, and `ninja big_mesh_test`."""
import subprocess
import sys
import time

import rosgraph
import roslib.packages
import rospy

import rviz_window


def memory_mb(process, key="VmRSS"):
    with open("/proc/%d/status" % process.pid, encoding="ascii") as file:
        return next(int(line.split()[1]) / 1024 for line in file if line.startswith(key + ":"))


def main():
    kind, cells = sys.argv[1:3]
    rospy.init_node("measure_big_mesh")
    window = rviz_window.RvizWindow(rosgraph.get_master_uri())
    text = (rviz_window.HERE / "four_fields.rviz").read_text(encoding="utf-8")
    text = text.replace("Scale: 25", "Scale: 5")
    if kind == "marker":
        text = text.replace("facet_mapping/LabeledMesh", "rviz/Marker").replace(
            "Topic: /mapper/mesh", "Marker Topic: /mapper/mesh_marker")
    window.write_config = lambda properties="": window.written
    window.written = window._folder.name + "/big.rviz"
    with open(window.written, "w", encoding="utf-8") as file:
        file.write(text)
    window.start()
    time.sleep(5)
    idle = memory_mb(window.rviz)
    publisher = subprocess.Popen([roslib.packages.find_node("facet_mapping", "big_mesh")[0], kind,
                                  cells], stdout=subprocess.PIPE, text=True)
    line = publisher.stdout.readline()
    start = float(line.split()[1].rstrip(","))
    # Corners of the ground, 60 m out, as if at the 25 pixels per metre of Picture.at.
    corners = [(x * 12.1, y * 12.1) for x in (-1, 1) for y in (-1, 1)]

    def is_all_there(picture):
        return all(picture.at(*corner) != (32, 36, 40) for corner in corners)

    picture = window.wait_for(is_all_there)
    seen = time.time() - start
    assert is_all_there(picture), "not all of the mesh was seen"
    time.sleep(10)
    if len(sys.argv) > 3:
        window.picture(sys.argv[3])
    print("%s: %s visible after %.1f s; rviz idle %.0f MB, with it %.0f MB, peak %.0f MB" % (
        kind, line.strip(), seen, idle, memory_mb(window.rviz), memory_mb(window.rviz, "VmHWM")))
    publisher.terminate()
    publisher.wait()
    window.close()


if __name__ == "__main__":
    main()
