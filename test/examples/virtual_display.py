# SPDX-License-Identifier: GPL-3.0-or-later
"""A display without a screen (Xvfb), what is seen on it, and a hand that gives it real events: motion, buttons and keys by
the XTest extension, a window manager's request to close, and files dropped by the protocol XDND."""
import atexit
import ctypes
import ctypes.util
import os
import shutil
import struct
import subprocess
import sys
import tempfile
import time

SKIPPED = 77  # what CMake takes for skipped


def environment_on(display):
    """Of a program with a window on the display of this name; empty, or None: there is none."""
    environment = dict(os.environ, LP_NUM_THREADS="1")
    # Drivers of OpenGL leak, and are unloaded when that is looked at: nothing would tell them from others.
    environment.setdefault("ASAN_OPTIONS", "detect_leaks=0")
    environment.pop("DISPLAY", None)
    environment.pop("WAYLAND_DISPLAY", None)
    if display:
        environment["DISPLAY"] = display
    return environment


class Display:
    """Ends the test as skipped where there is no Xvfb; ends with the test."""

    def __init__(self):
        if shutil.which("Xvfb") is None:
            print("skipped: there is no Xvfb (Debian: xvfb), so no window can be opened without a display")
            sys.exit(SKIPPED)
        self.folder = tempfile.mkdtemp()
        read, write_end = os.pipe()
        self.server = subprocess.Popen(["Xvfb", "-displayfd", str(write_end), "-screen", "0", "1300x1000x24", "-nolisten", "tcp",
                                        "-fbdir", self.folder], pass_fds=[write_end], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        atexit.register(self.end)
        os.close(write_end)
        number = b""
        while not number.endswith(b"\n"):
            part = os.read(read, 16)
            if not part:
                print("skipped: Xvfb does not start")
                sys.exit(SKIPPED)
            number += part
        self.name = ":" + number.decode().strip()

    def end(self):
        self.server.terminate()
        self.server.wait()
        shutil.rmtree(self.folder)

    def seen(self, left, top, width, height):
        """The screen's pixels in a rectangle, row by row, as blue, green, red and an unused byte each: the server's own memory
        in the format of xwd."""
        with open(os.path.join(self.folder, "Xvfb_screen0"), "rb") as file:
            data = file.read()
        header = struct.unpack(">25I", data[:100])
        begin, bytes_a_row = header[0] + 12 * header[19], header[12]
        rows = [begin + y * bytes_a_row for y in range(top, top + height)]
        return b"".join(data[row + 4 * left:row + 4 * (left + width)] for row in rows)


def library(name):
    path = ctypes.util.find_library(name)
    if path is None:
        print(f"skipped: there is no lib{name} (Debian: libx11-6, libxtst6), so no events can be given to a window")
        sys.exit(SKIPPED)
    return ctypes.CDLL(path)


class Event(ctypes.Union):
    """XEvent: in all events used here each member takes a long, the ints among them its lower half."""
    _fields_ = [("type", ctypes.c_int), ("word", ctypes.c_long * 24)]


class Hand:
    """Everything that it does has reached the server when it returns."""
    CLIENT_MESSAGE, SELECTION_REQUEST, SELECTION_NOTIFY = 33, 30, 31

    def __init__(self, display):
        self.x, self.test = library("X11"), library("Xtst")
        for name in ("XOpenDisplay", "XDefaultRootWindow", "XInternAtom", "XStringToKeysym", "XCreateSimpleWindow"):
            getattr(self.x, name).restype = ctypes.c_void_p if name == "XOpenDisplay" else ctypes.c_ulong
        self.display = ctypes.c_void_p(self.x.XOpenDisplay(display.name.encode()))
        self.root = self.x.XDefaultRootWindow(self.display)
        self.at = (0, 0)

    def atom(self, name):
        return self.x.XInternAtom(self.display, name.encode(), 0)

    def sync(self):
        self.x.XSync(self.display, 0)

    def windows(self):
        """The identities of the windows that have a title, with their titles."""
        root, parent, children, number = ctypes.c_ulong(), ctypes.c_ulong(), ctypes.POINTER(ctypes.c_ulong)(), ctypes.c_uint()
        self.x.XQueryTree(self.display, ctypes.c_ulong(self.root), ctypes.byref(root), ctypes.byref(parent), ctypes.byref(children),
                          ctypes.byref(number))
        found = {}
        for i in range(number.value):
            name = ctypes.c_char_p()
            if self.x.XFetchName(self.display, ctypes.c_ulong(children[i]), ctypes.byref(name)):
                found[children[i]] = name.value.decode("latin-1")  # the property is a STRING where that suffices
        return found

    def move(self, x, y, steps=1):
        """From where it is, in this many motions. Pixels of the screen."""
        from_x, from_y = self.at
        for i in range(1, steps + 1):
            self.at = round(from_x + (x - from_x) * i / steps), round(from_y + (y - from_y) * i / steps)
            self.test.XTestFakeMotionEvent(self.display, -1, *self.at, ctypes.c_ulong(0))
            self.sync()
            if steps > 1:
                time.sleep(0.02)

    def button(self, number, down):
        """1: left, 2: middle, 3: right, 4 and 5: the wheel."""
        self.test.XTestFakeButtonEvent(self.display, number, int(down), ctypes.c_ulong(0))
        self.sync()

    def click(self, number=1):
        self.button(number, True)
        self.button(number, False)

    def key_goes(self, name, down):
        code = self.x.XKeysymToKeycode(self.display, ctypes.c_ulong(self.x.XStringToKeysym(name.encode())))
        self.test.XTestFakeKeyEvent(self.display, code & 255, int(down), ctypes.c_ulong(0))
        self.sync()

    def key(self, *names):
        """The last one, pressed while the others are down, by X's names of keys."""
        for name in names:
            self.key_goes(name, True)
        for name in reversed(names):
            self.key_goes(name, False)

    def send(self, window, kind, *data):
        event = Event()
        event.type = self.CLIENT_MESSAGE
        event.word[4:7] = window, self.atom(kind), 32
        event.word[7:7 + len(data)] = data
        self.x.XSendEvent(self.display, ctypes.c_ulong(window), 0, ctypes.c_long(0), ctypes.byref(event))
        self.sync()

    def close(self, window):
        """As a window manager does when its button is clicked."""
        self.send(window, "WM_PROTOCOLS", self.atom("WM_DELETE_WINDOW"), 0)

    def drop(self, window, path, patience=5.0):
        """Drops a file on a window, as XDND's source. \\return whether the window says that it has taken it"""
        uri = ("file://" + "".join(c if c.isalnum() or c in "/._-" else "".join("%%%02X" % b for b in c.encode()) for c in path) + "\r\n").encode()
        kind, selection = self.atom("text/uri-list"), self.atom("XdndSelection")
        source = self.x.XCreateSimpleWindow(self.display, ctypes.c_ulong(self.root), 0, 0, 1, 1, 0, ctypes.c_ulong(0), ctypes.c_ulong(0))
        self.x.XSetSelectionOwner(self.display, ctypes.c_ulong(selection), ctypes.c_ulong(source), ctypes.c_ulong(0))
        self.send(window, "XdndEnter", source, 5 << 24, kind, 0, 0)
        self.send(window, "XdndPosition", source, 0, self.at[0] << 16 | self.at[1], 0, self.atom("XdndActionCopy"))
        self.send(window, "XdndDrop", source, 0, 0)
        end, event, finished = time.monotonic() + patience, Event(), self.atom("XdndFinished")
        while time.monotonic() < end:
            if not self.x.XPending(self.display):
                time.sleep(0.005)
                continue
            self.x.XNextEvent(self.display, ctypes.byref(event))
            if event.type == self.SELECTION_REQUEST:
                requestor, target, place, moment = event.word[5], event.word[7], event.word[8], event.word[9]
                self.x.XChangeProperty(self.display, ctypes.c_ulong(requestor), ctypes.c_ulong(place), ctypes.c_ulong(target), 8, 0, uri, len(uri))
                answer = Event()
                answer.type = self.SELECTION_NOTIFY
                answer.word[4:9] = requestor, selection, target, place, moment
                self.x.XSendEvent(self.display, ctypes.c_ulong(requestor), 0, ctypes.c_long(0), ctypes.byref(answer))
                self.sync()
            elif event.type == self.CLIENT_MESSAGE and event.word[5] == finished:
                self.x.XDestroyWindow(self.display, ctypes.c_ulong(source))
                self.sync()
                return event.word[8] != 0  # GLFW puts the number of bytes there
        return False
