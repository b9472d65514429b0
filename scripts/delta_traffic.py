#!/usr/bin/python3
# SPDX-FileCopyrightText: facet_mapping contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The inner part of scripts/measure_delta_traffic: plays a bag into stereo_points and mapper, records
/mapper/mesh and counts its bytes."""
import argparse
import collections
import contextlib
import os
import signal
import socket
import subprocess
import sys
import time

import drive_laps
from measuring import markdown_table, say

HEADER_BYTES = 4 + 8  # seq and stamp; the frame follows with its length
UPDATE_PERIOD_S = 0.5  # the mapper's default
MARKER_BYTES_PER_FACET = 3 * 24  # float64 corners, colour per class


def bytes_of_chunk(chunk):
    """Of the chunk in a message."""
    arrays = (12 * len(chunk.vertices) + 4 * len(chunk.vertex_ids) + 4 * len(chunk.triangles)
              + 2 * len(chunk.labels) + len(chunk.confidence) + 2 * len(chunk.views))
    return 12 + 4 + 24 + 6 * 4 + arrays


def bytes_of_envelope(mesh):
    """Of the message without its chunks."""
    return (HEADER_BYTES + 4 + len(mesh.header.frame_id) + 4 + len(mesh.map_id) + 4 + 1 + 4
            + 4 + 4 * len(mesh.removed_keys) + 4)


def facets_of(chunk):
    """What each facet carries, by its vertices' ids."""
    corners = [chunk.vertex_ids[v] for v in chunk.triangles]
    attributes = zip(chunk.labels, chunk.confidence, chunk.views)
    return dict(zip(zip(corners[0::3], corners[1::3], corners[2::3]), attributes))


class Traffic:
    """Follows the messages of one map."""

    def __init__(self):
        self.chunks = {}   # key: (bytes, facets)
        self.content = {}  # key: facets_of the chunk
        self.sent = collections.Counter()  # facets in deltas, by what is new about them
        self.updates = []  # (stamp, bytes sent, bytes of the whole mesh, facets)

    def add(self, mesh, size):
        assert size == bytes_of_envelope(mesh) + sum(map(bytes_of_chunk, mesh.chunks))
        keys = mesh.removed_keys
        for k in range(0, len(keys), 3):
            self.chunks.pop(tuple(keys[k:k + 3]), None)
        for chunk in mesh.chunks:
            self.count(chunk)
            self.chunks[tuple(chunk.key)] = (bytes_of_chunk(chunk), len(chunk.triangles) // 3)
        if mesh.full:  # what the recorder got as a newcomer
            return
        whole = bytes_of_envelope(mesh) - 4 * len(keys) + sum(b for b, _ in self.chunks.values())
        self.updates.append((mesh.header.stamp.to_sec(), size, whole,
                             sum(f for _, f in self.chunks.values())))


    def count(self, chunk):
        """Why the facets of a chunk are sent."""
        now, key = facets_of(chunk), tuple(chunk.key)
        before = self.content.get(key, {})
        for corners, attributes in now.items():
            known = before.get(corners)
            self.sent["new" if known is None else
                      "same" if known == attributes else "other attributes"] += 1
        self.content[key] = now


def table_of(updates, laps=1):
    """Sums over growing parts of the drive: quarters, or laps."""
    begin, rows = updates[0][0], []
    parts = laps if laps > 1 else 4
    for number in range(1, parts + 1):
        part = updates[:max(1, round(number / parts * len(updates)))]
        seconds = max(part[-1][0] - begin, 1e-9)
        sent, whole = sum(u[1] for u in part), sum(u[2] for u in part)
        marker = sum(MARKER_BYTES_PER_FACET * u[3] for u in part)
        rows.append(["%.1f" % seconds, str(len(part)), "%d" % part[-1][3],
                     "%.2f" % (sent / len(part) / 1e6), "%.2f" % (whole / len(part) / 1e6),
                     "%.2f" % (sent / seconds / 1e6), "%.2f" % (whole / seconds / 1e6),
                     "1/%.1f" % (whole / sent), "1/%.1f" % (marker / sent)])
    return markdown_table(
        ["seconds of the drive", "updates", "facets at the end", "MB an update", "whole mesh: MB",
         "MB/s", "whole mesh each time: MB/s", "deltas / whole mesh", "deltas / Marker"], rows)


def free_port():
    with contextlib.closing(socket.socket()) as probe:
        probe.bind(("localhost", 0))
        return probe.getsockname()[1]


class Processes:
    """Ends what it started, the last first."""

    def __init__(self):
        self.all = []

    def start(self, *command):
        say("  " + " ".join(command))
        self.all.append(subprocess.Popen(command, stdout=subprocess.DEVNULL))
        return self.all[-1]

    def stop_last(self):
        process = self.all.pop()
        process.send_signal(signal.SIGINT)
        try:
            process.wait(30)
        except subprocess.TimeoutExpired:
            process.kill()
            process.wait()

    def stop_all(self):
        while self.all:
            self.stop_last()


def wait_for_map(recorder):
    """Until every frame is in the map and nothing has changed for a while."""
    import rospy
    from facet_mapping.msg import MeshStats
    last, since = None, time.monotonic()
    while time.monotonic() - since < 20.0:
        if recorder.poll() is not None:
            sys.exit("the recorder ended")
        stats = rospy.wait_for_message("/mapper/stats", MeshStats, timeout=60.0)
        if stats.sequence != last or stats.pending > 0 or stats.sequence == 0:
            last, since = stats.sequence, time.monotonic()
            say("  update %d (%.1f s), %d keyframes, %d facets, %d frames wait"
                % (stats.sequence, stats.update_seconds, stats.keyframes, stats.facets,
                   stats.pending))


def play(arguments, parameters):
    os.environ["ROS_MASTER_URI"] = "http://localhost:%d" % free_port()
    os.environ["ROS_HOSTNAME"] = "localhost"
    import rospy
    processes = Processes()
    try:
        processes.start("roscore", "-p", os.environ["ROS_MASTER_URI"].rsplit(":", 1)[1])
        set_time = ["rosparam", "set", "/use_sim_time", "true"]
        while subprocess.run(set_time, stderr=subprocess.DEVNULL, check=False).returncode != 0:
            time.sleep(0.5)  # the master is not up yet
        overlay = arguments.mesh_bag + ".yaml"
        with open(overlay, "w", encoding="utf-8") as file:
            with open(os.path.join(os.path.dirname(__file__), "../config/datasets/kitti.yaml"),
                      encoding="utf-8") as defaults:
                text = defaults.read()
            values = dict(p.split(":=", 1) for p in parameters)  # the last of a name counts
            lines = "".join("  %s: %s\n" % value for value in values.items())
            file.write(text.replace("mapper:\n", "mapper:\n" + lines))
        recorder = processes.start("rosbag", "record", "-q", "-b", "0", "-O", arguments.mesh_bag,
                                   "/mapper/mesh")
        processes.start("roslaunch", "facet_mapping", "kitti.launch", "bag:=" + arguments.bag,
                        "refine:=false", "rate:=%g" % arguments.rate, "delay:=8",
                        "overlay:=" + overlay)
        rospy.init_node("delta_traffic", disable_signals=True)
        wait_for_map(recorder)
        processes.stop_last()
    finally:
        processes.stop_all()


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("bag")
    parser.add_argument("mesh_bag")
    parser.add_argument("--rate", type=float, default=1.0)
    parser.add_argument("--laps", type=int, default=1)
    arguments, parameters = parser.parse_known_args()
    # Of the drive's time, so that a slow machine sees the updates of a fast one.
    parameters.insert(0, "update_period_s:=%g" % (UPDATE_PERIOD_S / arguments.rate))
    if arguments.laps > 1:
        say("  laying the drive end to end %d times" % arguments.laps)
        long_bag = arguments.bag + ".laps.bag"
        drive_laps.write_laps(arguments.bag, arguments.laps, long_bag)
        arguments.bag = long_bag
    play(arguments, parameters)
    import rosbag
    traffic = Traffic()
    with rosbag.Bag(arguments.mesh_bag) as bag:
        for _, (_, data, _, _, kind), _ in bag.read_messages(raw=True):
            traffic.add(kind().deserialize(data), len(data))
    if not traffic.updates:
        sys.exit("no update came on /mapper/mesh")
    print(table_of(traffic.updates, arguments.laps))
    total = sum(traffic.sent.values())
    print("\nFacets in the deltas: " + ", ".join(
        "%s %.0f %%" % (what, 100.0 * count / total) for what, count in traffic.sent.items()))


if __name__ == "__main__":
    main()
