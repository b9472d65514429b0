# SPDX-FileCopyrightText: facet_mapping contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""An rviz under Xvfb with software GL: loads configurations, takes pictures."""
import os
import pathlib
import shutil
import signal
import subprocess
import tempfile
import time
import typing

import rospy
import Xlib.display
import Xlib.ext.xtest
import Xlib.X
import Xlib.XK
from std_msgs.msg import Bool, String

HERE = pathlib.Path(__file__).resolve().parent
NEEDED = ("Xvfb", "rviz", "import")
WIDTH, HEIGHT = 1280, 800
CENTRE = (814, 416)  # pixel in the middle of the view of four_fields.rviz
TIMEOUT_S = 60  # far more than needed, so that a slow machine does not fail the test


class SendFilePath:
    """rviz/SendFilePath, for which Debian ships no Python class: one string to one bool."""
    _type = "rviz/SendFilePath"
    _md5sum = "*"
    _request_class = String
    _response_class = Bool


def missing():
    return [name for name in NEEDED if shutil.which(name) is None]


class View(typing.NamedTuple):
    """Seen from straight above."""
    scale: float = 25  # pixels per metre
    x: float = 0  # of the point in the middle, in metres
    y: float = 0

    def pixel_of(self, x, y):
        """Column and row on the screen of the point (x, y), in metres."""
        return (round(CENTRE[0] + self.scale * (x - self.x)),
                round(CENTRE[1] - self.scale * (y - self.y)))


class Picture:
    def __init__(self, ppm, view=View()):
        self._pixels = ppm[-3 * WIDTH * HEIGHT:]
        self._view = view

    def at(self, x, y):
        """Colour of the point (x, y) on the ground, in metres."""
        return self.pixel(*self._view.pixel_of(x, y))

    def pixel(self, column, row):
        start = 3 * (row * WIDTH + column)
        return tuple(self._pixels[start:start + 3])

    def count(self, color):
        """Pixels of exactly this colour."""
        found, place = 0, self._pixels.find(bytes(color))
        while place >= 0:
            found += place % 3 == 0
            place = self._pixels.find(bytes(color), place + 1)
        return found


class RvizWindow:
    def __init__(self, master_uri):
        self._folder = tempfile.TemporaryDirectory()
        self._processes = []
        self.screen_name = self._start_screen()
        self._env = dict(os.environ, DISPLAY=self.screen_name, LIBGL_ALWAYS_SOFTWARE="1",
                         QT_X11_NO_MITSHM="1", ROS_MASTER_URI=master_uri,
                         HOME=self._folder.name, XDG_RUNTIME_DIR=self._folder.name)
        self._screen = None
        self.topic = "/mapper/mesh"  # this and the view: of configurations written from now on
        self.view = View()
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
        text = text.replace("Topic: /mapper/mesh", "Topic: " + self.topic).replace(
            "Scale: 25\n      X: 0\n      Y: 0", "Scale: %g\n      X: %g\n      Y: %g" % self.view)
        indented = "".join("      " + line + "\n" for line in properties.splitlines())
        return self.write_file(
            text.replace("      Lighting: false\n", "      Lighting: false\n" + indented))

    def write_file(self, text):
        path = os.path.join(self._folder.name, "shown.rviz")
        with open(path, "w", encoding="utf-8") as file:
            file.write(text)
        return path

    def start(self, properties=""):
        self.rviz = subprocess.Popen(
            ["rviz", "-d", self.write_config(properties), "__name:=rviz"], env=self._env,
            stdout=self._log, stderr=subprocess.STDOUT)
        self._processes.append(self.rviz)
        rospy.wait_for_service("/rviz/load_config_discarding_changes", timeout=TIMEOUT_S)

    def stop(self, sign=signal.SIGTERM):
        self.rviz.send_signal(sign)
        self.rviz.wait(timeout=TIMEOUT_S)

    def load(self, properties=""):
        self.load_file(self.write_config(properties))

    def load_file(self, path):
        rospy.ServiceProxy("/rviz/load_config_discarding_changes", SendFilePath)(path)

    def is_alive(self):
        return self.rviz.poll() is None

    def picture(self, path=None):
        ppm = subprocess.run(["import", "-window", "root", "-depth", "8", "ppm:-"], env=self._env,
                             check=True, stdout=subprocess.PIPE).stdout
        if path:
            subprocess.run(["convert", "ppm:-", path], input=ppm, check=True)
        return Picture(ppm, self.view)

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
        self.click(*self.view.pixel_of(x, y))

    def press(self, key):
        """A key by its X name, such as "i" or "Return"."""
        screen = self._connect()
        code = screen.keysym_to_keycode(Xlib.XK.string_to_keysym(key))
        for kind in (Xlib.X.KeyPress, Xlib.X.KeyRelease):
            Xlib.ext.xtest.fake_input(screen, kind, code)
        screen.sync()

    def color_at(self, x, y):
        """As Picture.at, of the screen as it is now: far faster than a picture."""
        column, row = self.view.pixel_of(x, y)
        root = self._connect().screen().root
        data = root.get_image(column, row, 1, 1, Xlib.X.ZPixmap, 0xffffffff).data
        return data[2], data[1], data[0]

    def _connect(self):
        if self._screen is None:
            self._screen = Xlib.display.Display(self.screen_name)
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
