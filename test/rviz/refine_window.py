# SPDX-FileCopyrightText: facet_mapping contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""An rviz with the panel Refine. It is driven through its keyboard shortcuts (Alt and the underlined
letter), which hold wherever a font puts the widgets."""
import os
import time

import rviz_window
import Xlib.error
import Xlib.ext.xtest
import Xlib.X
import Xlib.XK

COLUMNS = range(0, 400)  # of the screen that hold the panel
ANSWER = range(500, 800)  # rows that hold the answer, below the fields and most of the plot
PLOT = range(400, 720)


def is_near(color):
    return lambda *rgb: all(abs(a - b) < 5 for a, b in zip(rgb, color))


is_photometric = is_near((230, 120, 0))
is_semantic = is_near((30, 110, 220))
is_good = is_near((30, 140, 60))
is_stopped = is_near((176, 120, 0))
is_bad = is_near((200, 40, 40))


def is_bar(red, green, blue):
    return red < 90 and 125 < green < 190 and blue > 180


def like(picture, is_right, columns=COLUMNS, rows=range(rviz_window.HEIGHT)):
    """The (column, row) of all pixels whose colour is right."""
    return {(column, row) for row in rows for column in columns
            if is_right(*picture.pixel(column, row))}


def bar_length(picture):
    """Of the progress bar's filled part, in pixels: no other row holds as many of its colour."""
    rows = [row for _, row in like(picture, is_bar)]
    return max((rows.count(row) for row in set(rows)), default=0)


class RefineWindow(rviz_window.RvizWindow):
    def __init__(self, master_uri):
        super().__init__(master_uri)
        self.panel_lines = self.view_lines = ""  # of configurations written from now on

    def config_path(self):
        return os.path.join(self._folder.name, "shown.rviz")

    def write_config(self, properties=""):
        text = (rviz_window.HERE / "refine_panel.rviz").read_text(encoding="utf-8")
        for line, more in (("      Lighting: false\n", properties),
                           ("    Name: Refine\n", self.panel_lines),
                           ("      Angle: 0\n", self.view_lines)):
            indent = line[:len(line) - len(line.lstrip())]
            text = text.replace(line, line + "".join(indent + m + "\n" for m in more.splitlines()))
        with open(self.config_path(), "w", encoding="utf-8") as file:
            file.write(text)
        return self.config_path()

    def load_panel(self, panel="", view=""):
        self.panel_lines, self.view_lines = panel, view
        self.load()

    def shortcut(self, key, modifier="Alt_L"):
        self.focus()
        time.sleep(0.2)
        self._press(Xlib.XK.string_to_keysym(key), modifier)
        time.sleep(0.2)

    def fill(self, letter, text):
        """The field with this shortcut, with ASCII characters."""
        self.shortcut(letter)
        self.shortcut("a", "Control_L")
        self.type(text)

    def type(self, text):
        screen = self._connect()
        for character in text:
            code = screen.keysym_to_keycode(ord(character))
            is_plain = screen.keycode_to_keysym(code, 0) == ord(character)
            self._press(ord(character), *([] if is_plain else ["Shift_L"]))

    def _press(self, symbol, *modifiers):
        screen = self._connect()
        codes = [screen.keysym_to_keycode(Xlib.XK.string_to_keysym(name)) for name in modifiers]
        codes.append(screen.keysym_to_keycode(symbol))
        for code in codes:
            Xlib.ext.xtest.fake_input(screen, Xlib.X.KeyPress, code)
        for code in reversed(codes):
            Xlib.ext.xtest.fake_input(screen, Xlib.X.KeyRelease, code)
        screen.sync()

    def focus(self):
        """There is no window manager that would do so: gives the keys to rviz's main window."""
        screen = self._connect()
        for window in screen.screen().root.query_tree().children:
            try:
                is_shown = window.get_attributes().map_state == Xlib.X.IsViewable
                if is_shown and window.get_geometry().width > rviz_window.WIDTH // 2:
                    window.set_input_focus(Xlib.X.RevertToParent, Xlib.X.CurrentTime)
            except Xlib.error.BadWindow:
                pass  # one that rviz has closed meanwhile
        screen.sync()
