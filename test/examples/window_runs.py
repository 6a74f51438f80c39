# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs sculpt_window by scripts under Xvfb, replays its logs with sculpt, and reads its screenshots. Arguments of the check that
imports this: sculpt, source folder, sculpt_window."""
import atexit
import colorsys
import json
import os
import resource
import shutil
import struct
import subprocess
import tempfile
import zlib

from program_runs import FURTHER as WINDOW, PATIENCE, bytes_of, check, run, write
from virtual_display import Display, environment_on

folder = tempfile.mkdtemp()
atexit.register(shutil.rmtree, folder, True)
at = lambda name: os.path.join(folder, name)
display = Display()


def start(*arguments, script="", display=display.name, disk=None):
    path = write(at("script.txt"), script)
    limit = disk and (lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (disk, disk)))
    return subprocess.Popen([WINDOW, *map(str, arguments), "--script", path], stdout=subprocess.PIPE,
                            stderr=subprocess.PIPE, text=True, env=environment_on(display), cwd=folder,
                            preexec_fn=limit)


def window(*arguments, script="", code=0, what="window", display=display.name, disk=None, patience=PATIENCE):
    process = start(*arguments, script=script, display=display, disk=disk)
    try:
        out, err = process.communicate(timeout=patience)
    except subprocess.TimeoutExpired:
        process.kill()
        out, err = process.communicate()
        check(False, f"{what}: has not ended after {patience} s: {out[-500:]} {err}")
        return [], err
    check(process.returncode == code, f"{what}: exit {process.returncode}, expected {code}: {err}")
    return [json.loads(line) for line in out.splitlines() if line.startswith("{")], err


def replayed(mesh, log, saved, what):
    """The log makes the same mesh again, bit for bit, by sculpt; and what was edited is not what was there."""
    done = run(mesh, "--log", log, "-o", at("again.off"))
    check(done.returncode == 0, f"{what}: sculpt does not replay the log: {done.stderr}")
    check(os.path.exists(saved) and bytes_of(saved) == bytes_of(at("again.off")), f"{what}: the replayed mesh is another one")
    check("blocked 0, " in done.stdout and "refused 0\n" in done.stdout, f"{what}: a line of the log is not made whole: {done.stdout[:500]}")


def read_png(path):
    """Width and rows of red, green, blue bytes, of a picture of eight bits without interlacing, as all of ours are."""
    data = bytes_of(path)
    width, height, depth, kind, _, _, interlaced = struct.unpack(">IIBBBBB", data[16:29])
    check((depth, kind, interlaced) == (8, 2, 0), f"{path}: a picture of another kind")
    packed, position = b"", 8
    while position < len(data):
        length, name = struct.unpack(">I4s", data[position:position + 8])
        packed += data[position + 8:position + 8 + length] if name == b"IDAT" else b""
        position += length + 12
    raw, rows, above = zlib.decompress(packed), [], bytearray(3 * width)
    for y in range(height):
        begin = y * (3 * width + 1)
        how, row = raw[begin], bytearray(raw[begin + 1:begin + 1 + 3 * width])
        for i in range(3 * width if how else 0):
            left, up, corner = row[i - 3] if i >= 3 else 0, above[i], above[i - 3] if i >= 3 else 0
            if how == 4:
                guess = left + up - corner
                near = min((abs(guess - left), 0, left), (abs(guess - up), 1, up), (abs(guess - corner), 2, corner))[2]
            else:
                near = {1: left, 2: up, 3: (left + up) // 2}[how]
            row[i] = (row[i] + near) & 255
        rows.append(row)
        above = row
    return width, rows


def pixels_of(path, hue, spread=0.05):
    """Those whose hue is this, and which are not pale, as x and y from the upper left."""
    width, rows = read_png(path)
    found = []
    for y, row in enumerate(rows):
        for x in range(width):
            r, g, b = row[3 * x:3 * x + 3]
            high, chroma = max(r, g, b), max(r, g, b) - min(r, g, b)
            if chroma > 64 and chroma > 0.35 * high:
                apart = abs((colorsys.rgb_to_hsv(r / 255, g / 255, b / 255)[0] - hue + 0.5) % 1 - 0.5)
                if apart < spread:
                    found.append((x + 0.5, y + 0.5))
    return found
