# SPDX-FileCopyrightText: facet_mapping contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""A stand-in for the refiner: keeps what it is asked, answers what and when it is told to."""
import queue
import sys
import threading

import rospy
from facet_mapping.msg import RefineProgress
from facet_mapping.srv import (CancelRefine, CancelRefineResponse, Refine, RefineResponse, SaveMesh,
                               SaveMeshResponse)


class RefineNode:
    def __init__(self, name):
        self.asked = queue.Queue()
        self.cancelled = queue.Queue()
        self.saved = queue.Queue()
        self.answer = RefineResponse()
        self.may_answer = threading.Event()
        self._progress = rospy.Publisher(name + "/progress", RefineProgress, queue_size=100)
        self._services = [rospy.Service(name + "/refine", Refine, self._refine),
                          rospy.Service(name + "/cancel_refine", CancelRefine, self._cancel),
                          rospy.Service(name + "/save_mesh", SaveMesh, self._save)]

    def begin(self):
        """As if nothing had ever been asked."""
        for kept in (self.asked, self.cancelled, self.saved):
            while not kept.empty():
                kept.get()
        self.answer = RefineResponse()
        self.may_answer.set()

    def tell(self, level, iteration, fraction, photometric, semantic):
        message = RefineProgress(level=level, iteration=iteration, fraction=fraction,
                                 seconds=100.0 * fraction)
        message.energy.photometric, message.energy.semantic = photometric, semantic
        self._progress.publish(message)

    def _refine(self, request):
        self.asked.put(request)
        self.may_answer.wait()
        return self.answer

    def _cancel(self, request):
        self.cancelled.put(request)
        response = CancelRefineResponse()
        response.status.message = "~refine stops at its next iteration"
        return response

    def _save(self, request):
        self.saved.put(request)
        response = SaveMeshResponse(path="/somewhere.ply", facets=4)
        response.status.message = "4 facets written to /somewhere.ply"
        return response


def main():
    """A process that can be killed while it is asked; says when it is there and when it is asked."""
    rospy.init_node("doomed")
    node = RefineNode(sys.argv[1])
    print("there", flush=True)
    node.asked.get()
    print("asked", flush=True)
    rospy.spin()


if __name__ == "__main__":
    main()
