# SPDX-FileCopyrightText: facet_mapping contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Passes a mapper's mesh on under another name, and loses messages when told to."""
import rospy
from facet_mapping.msg import ClassPalette, LabeledMesh
from facet_mapping.srv import GetMesh


class MeshRelay:
    """/mapper/mesh and /mapper/palette as NAME/mesh and NAME/palette; NAME/get_mesh if wanted. Only
    for listeners that come once the mapper has a mesh."""

    def __init__(self, name, with_get_mesh=True, without_class=None):
        self.without_class = without_class  # in the palette
        self.mesh_topic = name + "/mesh"
        self.to_lose = 0
        self.lost = 0
        self.passed_on = 0  # deltas
        self.newcomers = 0
        self.calls = 0
        self._get_mesh = rospy.ServiceProxy("/mapper/get_mesh", GetMesh)
        self._palette = rospy.Publisher(name + "/palette", ClassPalette, latch=True, queue_size=1)
        self._mesh = rospy.Publisher(self.mesh_topic, LabeledMesh, self, queue_size=100)
        self._service = with_get_mesh and rospy.Service(name + "/get_mesh", GetMesh, self._answer)
        self._subscribers = [rospy.Subscriber("/mapper/palette", ClassPalette, self._show_palette),
                             rospy.Subscriber("/mapper/mesh", LabeledMesh, self._pass_on)]

    def show_all_classes(self):
        self.without_class = None
        self._show_palette(rospy.wait_for_message("/mapper/palette", ClassPalette, timeout=60))

    def _show_palette(self, palette):
        self._palette.publish(ClassPalette(
            palette.header, palette.version, palette.source,
            [entry for entry in palette.classes if entry.id != self.without_class]))

    def _pass_on(self, message):
        if message.full:
            return  # what the relay got as a newcomer
        if self.to_lose > 0:
            self.to_lose -= 1
            self.lost += 1
            return
        self.passed_on += 1
        self._mesh.publish(message)

    def _answer(self, request):
        self.calls += 1
        return self._get_mesh(request)

    def peer_subscribe(self, _topic, _publish, publish_to_peer):
        self.newcomers += 1
        publish_to_peer(self._get_mesh().mesh)

    def peer_unsubscribe(self, _topic, _number):
        pass

    def close(self):
        for part in self._subscribers + [self._palette, self._mesh]:
            part.unregister()
        if self._service:
            self._service.shutdown()
