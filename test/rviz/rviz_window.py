# SPDX-FileCopyrightText: facet_mapping contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""An rviz under Xvfb with software GL: loads configurations, takes pictures."""
import os
import pathlib
import shutil
import subprocess
import tempfile
import time

import rospy
import Xlib.display
import Xlib.ext.xtest
import Xlib.X
import Xlib.XK
from std_msgs.msg import Bool, String

HERE = pathlib.Path(__file__).resolve().parent
NEEDED = ("Xvfb", "rviz", "import")
WIDTH, HEIGHT = 1280, 800
# Centre of the view and pixels per metre of four_fields.rviz.
CENTRE, SCALE = (814, 416), 25
TIMEOUT_S = 60  # far more than needed, so that a slow machine does not fail the test


class SendFilePath:
    """rviz/SendFilePath, for which Debian ships no Python class: one string to one bool."""
    _type = "rviz/SendFilePath"
    _md5sum = "*"
    _request_class = String
    _response_class = Bool


def missing():
    return [name for name in NEEDED if shutil.which(name) is None]


class Picture:
    def __init__(self, ppm):
        self._pixels = ppm[-3 * WIDTH * HEIGHT:]

    def at(self, x, y):
        """Colour of the point (x, y) on the ground, in metres."""
        column, row = round(CENTRE[0] + SCALE * x), round(CENTRE[1] - SCALE * y)
        return self.pixel(column, row)

    def pixel(self, column, row):
        start = 3 * (row * WIDTH + column)
        return tuple(self._pixels[start:start + 3])


class RvizWindow:
    def __init__(self, master_uri):
        self._folder = tempfile.TemporaryDirectory()
        self._processes = []
        self._display = self._start_screen()
        self._env = dict(os.environ, DISPLAY=self._display, LIBGL_ALWAYS_SOFTWARE="1",
                         QT_X11_NO_MITSHM="1", ROS_MASTER_URI=master_uri,
                         HOME=self._folder.name, XDG_RUNTIME_DIR=self._folder.name)
        self._screen = None
        self._log = open(os.path.join(self._folder.name, "rviz.log"), "wb")
        self.rviz = None

    def _start_screen(self):
        reader, writer = os.pipe()
        self._processes.append(subprocess.Popen(
            ["Xvfb", "-displayfd", str(writer), "-screen", "0", "%dx%dx24" % (WIDTH, HEIGHT),
             "+extension", "GLX"], pass_fds=[writer], stderr=subprocess.DEVNULL))
        os.close(writer)
        with os.fdopen(reader) as pipe:
            return ":" + pipe.readline().strip()

    def write_config(self, properties=""):
        """`properties`: further lines of the display."""
        text = (HERE / "four_fields.rviz").read_text(encoding="utf-8")
        path = os.path.join(self._folder.name, "shown.rviz")
        indented = "".join("      " + line + "\n" for line in properties.splitlines())
        with open(path, "w", encoding="utf-8") as file:
            file.write(text.replace("      Lighting: false\n", "      Lighting: false\n" + indented))
        return path

    def start(self, properties=""):
        self.rviz = subprocess.Popen(
            ["rviz", "-d", self.write_config(properties), "__name:=rviz"], env=self._env,
            stdout=self._log, stderr=subprocess.STDOUT)
        self._processes.append(self.rviz)
        rospy.wait_for_service("/rviz/load_config_discarding_changes", timeout=TIMEOUT_S)

    def stop(self):
        self.rviz.terminate()
        self.rviz.wait(timeout=TIMEOUT_S)

    def load(self, properties=""):
        path = self.write_config(properties)
        rospy.ServiceProxy("/rviz/load_config_discarding_changes", SendFilePath)(path)

    def is_alive(self):
        return self.rviz.poll() is None

    def picture(self, path=None):
        ppm = subprocess.run(["import", "-window", "root", "-depth", "8", "ppm:-"], env=self._env,
                             check=True, stdout=subprocess.PIPE).stdout
        if path:
            subprocess.run(["convert", "ppm:-", path], input=ppm, check=True)
        return Picture(ppm)

    def click(self, column, row, button=1):
        """At a pixel of the screen."""
        screen = self._connect()
        Xlib.ext.xtest.fake_input(screen, Xlib.X.MotionNotify, x=column, y=row)
        for kind in (Xlib.X.ButtonPress, Xlib.X.ButtonRelease):
            screen.sync()
            time.sleep(0.1)  # rviz takes both from its event queue, one per turn
            Xlib.ext.xtest.fake_input(screen, kind, button)
        screen.sync()

    def click_ground(self, x, y):
        """The point (x, y) on the ground, in metres."""
        self.click(round(CENTRE[0] + SCALE * x), round(CENTRE[1] - SCALE * y))

    def press(self, key):
        """A key by its X name, such as "i" or "Return"."""
        screen = self._connect()
        code = screen.keysym_to_keycode(Xlib.XK.string_to_keysym(key))
        for kind in (Xlib.X.KeyPress, Xlib.X.KeyRelease):
            Xlib.ext.xtest.fake_input(screen, kind, code)
        screen.sync()

    def _connect(self):
        if self._screen is None:
            self._screen = Xlib.display.Display(self._display)
        return self._screen

    def wait_for(self, is_right, path=None):
        """The first picture that is right, or the last one taken."""
        end = time.monotonic() + TIMEOUT_S
        while True:
            picture = self.picture(path)
            if is_right(picture) or time.monotonic() > end or not self.is_alive():
                return picture
            time.sleep(0.3)

    def close(self):
        if self._screen is not None:
            self._screen.close()
        for process in reversed(self._processes):
            if process.poll() is None:
                process.terminate()
            try:
                process.wait(timeout=20)
            except subprocess.TimeoutExpired:
                process.kill()
                process.wait()
        self._log.close()
        self._folder.cleanup()
