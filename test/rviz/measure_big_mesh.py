#!/usr/bin/python3
# SPDX-FileCopyrightText: facet_mapping contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Time from publishing to seeing all of a big mesh, rviz's memory and frames, for a mesh also the
time of switching a class off and on: measure_big_mesh.py (mesh|marker) CELLS [PICTURE]. Needs a ROS
master, and `ninja big_mesh_test`."""
import statistics
import subprocess
import sys
import time

import rosgraph
import roslib.packages
import rospy
import Xlib.display
import Xlib.ext.damage

import rviz_window

BACKGROUND = (32, 36, 40)
MIDDLES = [(x, y) for x in range(-60, 61, 8) for y in range(-60, 61, 8)]  # of all chunks, in metres
ON_THE_ROAD = (12, 4)  # the middle of a chunk of the class `road`
ROAD_CHECKBOX = (181, 398)  # pixel: the fourth row below `Classes` in four_fields.rviz
TOGGLES = 10
TIMEOUT_S = 120


class FrameClock:
    """When frames of the 3D view reached the screen, as the X server saw it."""

    def __init__(self, window):
        self._display = Xlib.display.Display(window.screen_name)
        self._display.damage_query_version()  # without which the server refuses the rest
        self._root = self._display.screen().root
        self._damage = self._root.damage_create(Xlib.ext.damage.DamageReportRawRectangles)
        self._display.sync()

    def news(self):
        """Milliseconds of the X server, one per frame since the last call."""
        self._display.sync()
        events = [self._display.next_event() for _ in range(self._display.pending_events())]
        self._display.damage_subtract(self._damage)
        frames = [e for e in events if e.type == self._display.extension_event.DamageNotify
                  and e.area.width > 600 and e.area.height > 400]
        return [frame.timestamp for frame in frames]


def memory_mb(process, key="VmRSS"):
    with open("/proc/%d/status" % process.pid, encoding="ascii") as file:
        return next(int(line.split()[1]) / 1024 for line in file if line.startswith(key + ":"))


def wait_for(is_done):
    """Seconds of the clock when it was so."""
    end = time.time() + TIMEOUT_S
    while not is_done():
        assert time.time() < end, "not seen"
        time.sleep(0.001)
    return time.time()


def frame_interval_ms(clock):
    """With all of the mesh in the view; rviz draws as often as it can, up to 15 times a second."""
    clock.news()
    time.sleep(10)
    times = clock.news()
    return (times[-1] - times[0]) / (len(times) - 1)


def measure_toggling(window, clock):
    """Seconds from releasing the mouse button to the other colour, and frames meanwhile."""
    seconds, frames = [], []
    for _ in range(TOGGLES):
        before = window.color_at(*ON_THE_ROAD)
        window.click(*ROAD_CHECKBOX)
        start = time.time()
        clock.news()
        seconds.append(wait_for(lambda: window.color_at(*ON_THE_ROAD) != before) - start)
        frames.append(len(clock.news()))
        time.sleep(1 + 0.137 * len(seconds))  # not in step with the frames
    print("a class switched off or on is seen after %.0f ms (median of %s), at the end of frame %s "
          "after the click (the first had mostly begun before)" % (
              1000 * statistics.median(seconds), ", ".join("%.0f" % (1000 * s) for s in seconds),
              ", ".join(map(str, frames))))


def configure(window, kind):
    if kind == "marker":
        window.written = window.write_config()
        with open(window.written, encoding="utf-8") as file:
            text = file.read()
        with open(window.written, "w", encoding="utf-8") as file:
            file.write(text.replace("facet_mapping/LabeledMesh", "rviz/Marker").replace(
                "Topic: /mapper/mesh", "Marker Topic: /mapper/mesh_marker"))
        window.write_config = lambda properties="": window.written


def measure(window, publisher, kind):
    idle = memory_mb(window.rviz)
    line = publisher.stdout.readline()
    start = float(line.split()[1].rstrip(","))
    seen = max(wait_for(lambda p=p: window.color_at(*p) != BACKGROUND) for p in MIDDLES) - start
    time.sleep(10)
    print("%s: %s visible after %.2f s; rviz idle %.0f MB, with it %.0f MB, peak %.0f MB" % (
        kind, line.strip(), seen, idle, memory_mb(window.rviz), memory_mb(window.rviz, "VmHWM")))
    clock = FrameClock(window)
    print("a frame every %.0f ms" % frame_interval_ms(clock))
    if kind == "mesh":
        measure_toggling(window, clock)


def main():
    kind, cells = sys.argv[1:3]
    rospy.init_node("measure_big_mesh")
    window = rviz_window.RvizWindow(rosgraph.get_master_uri())
    publisher = None
    try:
        window.view = rviz_window.View(scale=5)
        configure(window, kind)
        window.start()
        time.sleep(5)
        publisher = subprocess.Popen([roslib.packages.find_node("facet_mapping", "big_mesh")[0],
                                      kind, cells], stdout=subprocess.PIPE, text=True)
        measure(window, publisher, kind)
        if len(sys.argv) > 3:
            window.picture(sys.argv[3])
    finally:
        if publisher:
            publisher.terminate()
            publisher.wait()
        window.close()


if __name__ == "__main__":
    main()
