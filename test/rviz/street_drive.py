# SPDX-FileCopyrightText: facet_mapping contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""A drive along a synthetic street, given to running nodes frame by frame; what its map looks like
from above."""
import itertools
import os
import subprocess
import tempfile
import threading

import roslib.packages
import rosbag
import rospy
from nav_msgs.msg import Path

NAN = float("nan")
TRANSFORMS = ["/tf", "/tf_static"]
LEFT = ["/kitti/camera_color_left/" + name for name in ("image_raw", "camera_info", "segmentation")]
TIMEOUT_S = 60  # far more than needed, so that a slow machine does not fail the test


class StreetDrive:
    """Frames of a bag, stamped as if they came now; after the last one it begins anew."""

    def __init__(self, frames):
        with tempfile.TemporaryDirectory() as folder:
            program = roslib.packages.find_node("facet_mapping", "street_to_bag")[0]
            subprocess.run([program, folder, "--frames", str(frames), "--no-scans"], check=True,
                           stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
            with rosbag.Bag(os.path.join(folder, "street.bag")) as bag:
                messages = [(topic, message) for topic, message, _ in bag.read_messages()]
        self._frames = []
        for topic, message in messages:
            if topic == "/tf":
                self._frames.append([])
            if topic != "/tf_static":
                self._frames[-1].append((topic, message))
        self._publishers = {topic: rospy.Publisher(topic, type(message), queue_size=100,
                                                   latch=topic == "/tf_static")
                            for topic, message in messages}
        self._publishers["/tf_static"].publish(
            next(message for topic, message in messages if topic == "/tf_static"))
        self._next = 0
        self._mapped = threading.Condition()
        self._mapped_until = rospy.Time()
        self._subscriber = rospy.Subscriber("/mapper/keyframes", Path, self._hear)

    def _hear(self, path):
        with self._mapped:
            self._mapped_until = path.header.stamp
            self._mapped.notify_all()

    def wait_for_nodes(self, topics_by_node):
        """Until somebody listens to each topic, and each node to all of these topics."""
        for topic, publisher in self._publishers.items():
            wait_until(lambda p=publisher: p.get_num_connections() > 0, topic)
        for node, topics in {"/mapper": TRANSFORMS, **topics_by_node}.items():
            for topic in topics:
                wait_until(lambda n=node, t=topic: n in listeners_of(self._publishers[t]),
                           "%s to listen to %s" % (node, topic))

    def start_again(self):
        self._next = 0

    def drive_on(self, frames):
        """Until they are in the map."""
        for _ in range(frames):
            stamp = rospy.Time.now()
            for topic, message in self._frames[self._next % len(self._frames)]:
                stamp_message(message, stamp)
                self._publishers[topic].publish(message)
            self._next += 1
        almost = stamp - rospy.Duration(0, 1000)  # the map counts time in float64 seconds
        with self._mapped:
            if not self._mapped.wait_for(lambda: self._mapped_until >= almost, TIMEOUT_S):
                raise AssertionError("the mapper has not mapped frame %d" % self._next)


def listeners_of(publisher):
    """Names of nodes. rospy has no public way to ask."""
    return {connection.endpoint_id for connection in list(publisher.impl.connections)}


def stamp_message(message, stamp):
    for part in getattr(message, "transforms", [message]):
        part.header.stamp = stamp


def wait_until(is_done, what):
    end = rospy.Time.now() + rospy.Duration(TIMEOUT_S)
    while not is_done():
        if rospy.Time.now() > end:
            raise AssertionError("waited in vain for " + what)
        rospy.sleep(0.02)


class SeenFromAbove:
    """The topmost facets that some image has seen, on a grid of places."""

    STEP_M = 0.25
    FROM_BEHIND = -1  # instead of a class: drawn darker

    def __init__(self, mesh):
        self._top = {}  # place: (height, class)
        for chunk in mesh.chunks:
            corners = [(v.x + chunk.origin.x, v.y + chunk.origin.y, v.z + chunk.origin.z)
                       for v in chunk.vertices]
            views = chunk.views or [1] * len(chunk.labels)
            for facet, label in enumerate(chunk.labels):
                if views[facet] > 0:
                    self._add([corners[k] for k in chunk.triangles[3 * facet:3 * facet + 3]], label)

    def _add(self, triangle, label):
        ranges = []
        for axis in (0, 1):
            values = [corner[axis] / self.STEP_M for corner in triangle]
            ranges.append(range(int(min(values)) - 1, int(max(values)) + 2))
        if not faces_up(triangle):
            label = self.FROM_BEHIND
        for place in itertools.product(*ranges):
            height = height_at(triangle, place[0] * self.STEP_M, place[1] * self.STEP_M)
            if height > self._top.get(place, (-1e9,))[0]:
                self._top[place] = (height, label)

    def classes(self):
        """(x, y): class, None where there is nothing. Only places whose neighbours have the same
        class, so that a pixel's width does not matter."""
        found = {}
        columns, rows = ([place[axis] for place in self._top] or [0] for axis in (0, 1))
        for column, row in itertools.product(range(min(columns) - 4, max(columns) + 5),
                                             range(min(rows) - 4, max(rows) + 5)):
            around = {self._top.get((column + i, row + k), (0, None))[1]
                      for i in (-1, 0, 1) for k in (-1, 0, 1)}
            if len(around) == 1 and around != {self.FROM_BEHIND}:
                found[column * self.STEP_M, row * self.STEP_M] = around.pop()
        return found


def faces_up(triangle):
    (ax, ay, _), (bx, by, _), (cx, cy, _) = triangle
    return (bx - ax) * (cy - ay) > (cx - ax) * (by - ay)


def height_at(triangle, x, y):
    """Of the triangle at (x, y), which compares as lower than everything beside it."""
    (ax, ay, az), (bx, by, bz), (cx, cy, cz) = triangle
    area = (bx - ax) * (cy - ay) - (cx - ax) * (by - ay)
    if area == 0.0:
        return NAN
    b = ((x - ax) * (cy - ay) - (cx - ax) * (y - ay)) / area
    c = ((bx - ax) * (y - ay) - (x - ax) * (by - ay)) / area
    return NAN if b < 0.0 or c < 0.0 or b + c > 1.0 else az + b * (bz - az) + c * (cz - az)
