# SPDX-FileCopyrightText: facet_mapping contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""A long drive out of a short one: the same drive laid end to end."""
import math

import rosbag
import rospy
from geometry_msgs.msg import Quaternion, Vector3


def product(p, q):
    """Of quaternions (x, y, z, w)."""
    (a, b, c, d), (e, f, g, h) = p, q
    return (d * e + a * h + b * g - c * f, d * f - a * g + b * h + c * e,
            d * g + a * f - b * e + c * h, d * h - a * e - b * f - c * g)


class Rigid:
    """A rotation (unit quaternion x, y, z, w), then a translation."""

    def __init__(self, rotation=(0.0, 0.0, 0.0, 1.0), translation=(0.0, 0.0, 0.0)):
        length = math.sqrt(sum(value * value for value in rotation))
        self.rotation = tuple(value / length for value in rotation)
        self.translation = tuple(translation)

    def apply(self, point):
        x, y, z, w = self.rotation
        turned = product(product(self.rotation, (*point, 0.0)), (-x, -y, -z, w))
        return tuple(a + b for a, b in zip(turned, self.translation))

    def __mul__(self, other):
        return Rigid(product(self.rotation, other.rotation), self.apply(other.translation))

    def inverse(self):
        x, y, z, w = self.rotation
        back = Rigid((-x, -y, -z, w))
        return Rigid(back.rotation, [-value for value in back.apply(self.translation)])


def pose_of(transform):
    r, t = transform.rotation, transform.translation
    return Rigid((r.x, r.y, r.z, r.w), (t.x, t.y, t.z))


def lap_of(poses):
    """The motion from the begin of a lap to that of the next: to its last pose and one step on."""
    return poses[-1] * (poses[-2].inverse() * poses[-1]) * poses[0].inverse()


def shift(message, motion, seconds):
    """The message of a later lap; `motion` from the first lap's map."""
    later = rospy.Duration.from_sec(seconds)
    for part in getattr(message, "transforms", []):
        pose = motion * pose_of(part.transform)
        part.transform.rotation = Quaternion(*pose.rotation)
        part.transform.translation = Vector3(*pose.translation)
        part.header.stamp += later
    if hasattr(message, "header"):
        message.header.stamp += later


def write_laps(drive, laps, path):
    """The bag `drive` of kitti_to_bag or street_to_bag `laps` times end to end; only one message is
    in memory at a time."""
    with rosbag.Bag(drive) as bag, rosbag.Bag(path, "w") as long_bag:
        steps = [(stamp, pose_of(message.transforms[0].transform))
                 for _, message, stamp in bag.read_messages(["/tf"])]
        duration = (steps[-1][0] - steps[0][0]).to_sec()
        lap = lap_of([pose for _, pose in steps])
        motion, seconds = Rigid(), 0.0
        for number in range(laps):
            messages = bag.read_messages(return_connection_header=True)
            for topic, message, stamp, connection in messages:
                if topic == "/tf_static" and number > 0:
                    continue
                if topic != "/tf_static":
                    shift(message, motion, seconds)
                long_bag.write(topic, message, stamp + rospy.Duration.from_sec(seconds),
                               connection_header=connection)
            motion = motion * lap
            seconds += duration + duration / (len(steps) - 1)
