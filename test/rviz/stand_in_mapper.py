# SPDX-FileCopyrightText: facet_mapping contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""A mapper that shows the mesh that it is told to."""
import rospy
from facet_mapping.msg import ClassPalette, LabeledMesh
from facet_mapping.srv import GetMesh, GetMeshResponse

import mesh_messages


class Mapper:
    """Stands in for the node that publishes the mesh: like it, sends newcomers the whole mesh."""

    def __init__(self):
        self.full = mesh_messages.mesh(mesh_messages.four_fields())
        self.calls = 0
        self._palette = None
        self.show_palette()
        self._mesh = rospy.Publisher("/mapper/mesh", LabeledMesh, self, queue_size=10)
        self._service = rospy.Service("/mapper/get_mesh", GetMesh, self.answer)

    def show_palette(self):
        self._palette = rospy.Publisher("/mapper/palette", ClassPalette, latch=True, queue_size=1)
        self._palette.publish(mesh_messages.palette())

    def hide_palette(self):
        self._palette.unregister()

    def peer_subscribe(self, _topic, _publish, publish_to_peer):
        publish_to_peer(self.full)

    def peer_unsubscribe(self, _topic, _number):
        pass

    def answer(self, _request):
        self.calls += 1
        return GetMeshResponse(mesh=self.full)

    def show(self, message, full=None):
        self.full = full or message
        self._mesh.publish(message)
