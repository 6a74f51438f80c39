# SPDX-License-Identifier: GPL-3.0-or-later
"""Drives sculpt_window under Xvfb by real events of mouse, keys, window manager and dropped files; what it did is known from
its log, its recording, its title and the screen. Arguments: sculpt, source folder, sculpt_window."""
import atexit
import json
import math
import os
import shutil
import subprocess
import tempfile
import time

from box_mesh import box
from program_runs import FURTHER as WINDOW, PATIENCE, bytes_of, check, end, points, run, write
from virtual_display import Display, Hand, environment_on

display = Display()
hand = Hand(display)
folder = tempfile.mkdtemp()
atexit.register(shutil.rmtree, folder, True)
at = lambda name: os.path.join(folder, name)


def eventually(is_so, what, patience=PATIENCE / 10):
    """Events take their way: a frame, a tick and a write of the log."""
    due = time.monotonic() + patience
    while not is_so():
        if time.monotonic() > due:
            check(False, what)
            return False
        time.sleep(0.01)
    return True


def lines_of(path):
    return open(path).read().splitlines() if os.path.exists(path) else []


mesh, other, log, record, saved = write(at("box.off"), box(4)), at("other one é.off"), at("box.log"), at("hand.actions"), at("saved.off")
shutil.copy(mesh, other)
# A vertex on the box's top, and a place as far from the eye: across the view, a drag leads there.
SLANT = (0, 1, -0.5)
GOAL = (0, 0.3 * 0.5 / math.hypot(1, 0.5), 1 + 0.3 / math.hypot(1, 0.5))
script = write(at("script.txt"), f"""view {SLANT[0]} {SLANT[1]} {SLANT[2]}
settle
where @0,0,1
where @{GOAL[0]!r},{GOAL[1]!r},{GOAL[2]!r}
where @0.5,-0.5,1
where @0.5,-0.5,1.5
where @-0.5,-0.5,1
""")
SIZE = 800, 600
hand.move(SIZE[0] - 5, SIZE[1] - 5)
process = subprocess.Popen([WINDOW, mesh, "--log", log, "-o", saved, "--record", record, "--size", *map(str, SIZE),
                            "--samples", "0", "--script", script],
                           stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                           env=environment_on(display.name), cwd=folder)
atexit.register(process.kill)
places = [json.loads(process.stdout.readline())["where"] for _ in range(5)]
vertex, goal, second, above, third = places
time.sleep(0.1)  # the script's last action has been done: from the next frame on the hand's motions count


def title():
    return next((t for t in hand.windows().values() if t.startswith("sculpt_window")), "")


def number(word):
    """Of lines of the log that begin with a word; those that end a shift do not count."""
    words = [line.split()[0] for line in lines_of(log) if line]
    return words.count(word) - (words.count("shift") if word == "end" else 0)


def log_has(count, word, what):
    """This many lines of the log begin with the word."""
    eventually(lambda: number(word) == count, f"{what}: {lines_of(log)[4:]}")


def last_drag():
    return next(line.split() for line in reversed(lines_of(log)) if line.startswith("drag"))


def dragged(begin, to, button=1):
    hand.move(*begin)
    hand.button(button, True)
    hand.move(*to, steps=8)
    time.sleep(0.3)
    hand.button(button, False)


# A vertex is pressed, drawn, and let go.
identity = next(iter(hand.windows()))
hand.key("1")
check(title() == f"sculpt_window {mesh}", f"the title of a mesh just opened: {title()}")
dragged(vertex, goal)
log_has(1, "end", "a drag by the hand is one step of undo")
drag = last_drag()
moved = tuple(map(float.fromhex, drag[2:5]))
check(points(mesh)[int(drag[1])] == (0, 0, 1), f"the vertex that was pointed at is the one that moves: {drag}")
pixel = math.dist(GOAL, (0, 0, 1)) / math.dist(vertex, goal)
check(math.dist(moved, GOAL) < 2 * pixel, f"it goes where the mouse goes, {GOAL}, within two pixels of {pixel}: {moved}")
eventually(lambda: title() == f"sculpt_window {mesh} (not saved)", f"the title says that something is not saved: {title()}")

# Keys, alone and with others.
for i, (keys, word) in enumerate(((("u",), "undo"), (("Shift_L", "u"), "redo"), (("Control_L", "z"), "undo"), (("Control_L", "y"), "redo"))):
    hand.key(*keys)
    log_has(1 + i // 2, word, f"key {'+'.join(keys)}")

# Along the normal by shift; another button that is pressed meanwhile ends nothing.
hand.move(*second)
hand.key_goes("Shift_L", True)
hand.button(1, True)
hand.key_goes("Shift_L", False)
hand.move(*((a + b) / 2 for a, b in zip(second, above)), steps=4)
hand.click(3)
hand.move(*above, steps=4)
time.sleep(0.3)
hand.button(1, False)
log_has(2, "end", "a drag along the normal")
drag = last_drag()
moved = tuple(map(float.fromhex, drag[2:5]))
check(moved[:2] == (0.5, -0.5) and abs(moved[2] - 1.5) < 4 * pixel, f"shift drags along the normal: {drag}")

# A brush in the hand goes on as long as the button is down, one step of undo.
hand.key("i")
hand.move(*third)
hand.button(1, True)
eventually(lambda: number("shift") >= 10, "a brush held still goes on")
hand.button(1, False)
log_has(3, "end", "a stroke of a brush is one step of undo")
hand.key("1")

# What is seen: the wheel makes it larger, the right button turns it, h shows and hides the keys.
# Beside the panel, whose figures change.
VIEW, KEYS = (340, 100, 260, 400), (SIZE[0] - 300, 20, 280, 300)
seen = lambda rectangle: display.seen(*rectangle)


def covered():
    """How much is not of the colour of the corner, where no panel comes."""
    picture = seen((340, 0, SIZE[0] - 340, SIZE[1] - 120))
    return sum(picture[i:i + 3] != picture[-4:-1] for i in range(0, len(picture), 4))


def still(rectangle):
    """A picture that stays for some frames."""
    before, due = None, time.monotonic() + 5
    while before != (now := seen(rectangle)) and time.monotonic() < due:
        before = now
        time.sleep(0.1)
    return now


hand.move(SIZE[0] - 20, SIZE[1] - 20)
still(VIEW)
small = covered()
for notch in range(3):
    hand.click(5)
eventually(lambda: covered() < 0.9 * small, "the wheel makes it smaller")
for notch in range(3):
    hand.click(4)
eventually(lambda: covered() > 0.97 * small, "the wheel makes it larger")
plain, keys = still(VIEW), still(KEYS)
hand.key("h")
eventually(lambda: seen(KEYS) != keys, "h lists the keys")
check(sum(a != b for a, b in zip(still(KEYS), keys)) > len(keys) // 4, "the list covers what was there")
hand.key("h")
eventually(lambda: seen(KEYS) == keys, "h hides the list of keys")
hand.move(*vertex)
time.sleep(0.4)  # a panel that has gone lets go of the mouse with the next frame
plain = still(VIEW)
dragged(vertex, (vertex[0] + 60, vertex[1]), button=3)
eventually(lambda: seen(VIEW) != plain, "the right button turns")
plain = still(VIEW)
dragged((SIZE[0] - 20, SIZE[1] - 20), (SIZE[0] - 90, SIZE[1] - 40))
eventually(lambda: seen(VIEW) != plain, "the left button turns, beside the mesh")
log_has(3, "end", "turning changes nothing")

# A panel takes the mouse: a tool is chosen, nothing behind it is dragged.
before_panel = len(lines_of(log))
hand.move(30, 52)
time.sleep(0.4)  # the panel takes the mouse, or lets go of it, with the next frame
hand.click()
eventually(lambda: "tool probe" in lines_of(record), "a tool is chosen by its button")
check(len(lines_of(log)) == before_panel, "a click on a panel edits nothing")
hand.move(SIZE[0] - 20, SIZE[1] - 20)
time.sleep(0.4)
hand.key_goes("Control_L", True)
hand.click(4)
eventually(lambda: "scroll 1 ctrl" in lines_of(record), "ctrl and the wheel")
hand.key_goes("Control_L", False)
hand.key_goes("Shift_L", True)
hand.click(5)
eventually(lambda: "scroll -1 shift" in lines_of(record), "shift and the wheel")
hand.key_goes("Shift_L", False)
hand.key("Shift_L", "x")
eventually(lambda: "key shift+x" in lines_of(record), "shift and x")
hand.key("1")

# Closing asks while there is unsaved work; escape goes on; a second file is not opened over unsaved work at once.
MIDDLE = (SIZE[0] // 2 - 50, SIZE[1] // 2 - 20, 100, 40)
plain = still(MIDDLE)
hand.close(identity)
eventually(lambda: seen(MIDDLE) != plain, "closing asks")
noted = lines_of(record).count("key u")
hand.key("u")
time.sleep(0.2)
check(lines_of(record).count("key u") == noted, "a key that is not obeyed is not in the recording")
check(process.poll() is None and sum(line.startswith("undo") for line in lines_of(log)) == 2, "while it asks it goes on and no key is obeyed")
hand.key("Escape")
eventually(lambda: seen(MIDDLE) == plain, "escape goes on")
hand.move(*vertex)
check(hand.drop(identity, other), "a dropped file is taken")
time.sleep(0.3)
check(title() == f"sculpt_window {mesh} (not saved)", f"a file that is dropped once leaves no unsaved work: {title()}")

# Save by the dialogue: the name that it proposes, and return.
plain = still(MIDDLE)
hand.key("s")
eventually(lambda: seen(MIDDLE) != plain, "s asks for a name")
hand.key_goes("Return", True)  # until it is obeyed: Dear ImGui sees the keys that are down when a frame is drawn
eventually(lambda: os.path.exists(saved), "s and return save")
hand.key_goes("Return", False)
eventually(lambda: title() == f"sculpt_window {mesh}", f"the title after saving: {title()}")
done = run(mesh, "--log", shutil.copy(log, at("copy.log")), "-o", at("again.off"))
check(done.returncode == 0 and bytes_of(at("again.off")) == bytes_of(saved), f"the log of a hand makes the same mesh again: {done.stderr}")
check(sum(a != b for a, b in zip(points(mesh), points(saved))) == 3, "two vertices were dragged and one was brushed")
check(hand.drop(identity, other), "a dropped file is taken")
eventually(lambda: title() == f"sculpt_window {other}", f"a dropped file is opened: {title()}")

# "Save and quit" that is refused, as the name is that of what is open and its log begins with it, does not make a later save quit.
shutil.copy(mesh, saved)
check(hand.drop(identity, saved), "a dropped file is taken")
eventually(lambda: title() == f"sculpt_window {saved}", f"where it would be saved is opened: {title()}")
dragged(vertex, goal)
eventually(lambda: title().endswith("(not saved)"), "something is not saved")
hand.key("Tab")  # the panels would lie over a button
time.sleep(0.3)
plain, QUESTION = still(MIDDLE), (20, SIZE[1] // 2 - 60, SIZE[0] - 40, 120)
around = still(QUESTION)
hand.close(identity)
eventually(lambda: seen(MIDDLE) != plain, "closing asks again")
# The leftmost button is where something blue has come.
asked = still(QUESTION)
blue = [(i // 4 % QUESTION[2], i // 4 // QUESTION[2]) for i in range(0, len(asked), 4)
        if asked[i:i + 3] != around[i:i + 3] and asked[i] > 1.5 * asked[i + 2] and asked[i] > 60]
check(len(blue) > 1000, f"the question has buttons: {len(blue)} blue pixels")
left = min(x for x, y in blue) if blue else 0
rows = [y for x, y in blue if x < left + 10] or [0]
hand.move(QUESTION[0] + left + 15, QUESTION[1] + (min(rows) + max(rows)) // 2)
time.sleep(0.4)
hand.click()
eventually(lambda: seen(MIDDLE) == plain, "the question is answered")
time.sleep(0.3)
check(process.poll() is None, "a save that is refused quits")

# What is done while another mesh is read is not left by it, though that was dropped twice.
late = write(at("late.off"), box(250))
check(hand.drop(identity, late), "a dropped file is taken")
eventually(lambda: lines_of(record).count(f"open {late}") == 1, "a file that is dropped once over unsaved work is refused")
check(hand.drop(identity, late), "a dropped file is taken")
dragged(vertex, goal)  # while the button is down another mesh does not come
eventually(lambda: lines_of(record).count(f"open {late}") == 2, "it is refused once more", PATIENCE)
check(title() == f"sculpt_window {saved} (not saved)", f"a mesh that was long in coming is opened over work since: {title()}")
hand.move(*vertex)
plain = still(MIDDLE)
hand.key("s")
eventually(lambda: seen(MIDDLE) != plain, "s asks for a name again")
time.sleep(0.3)  # the field takes the keys with the next frame
for key in ("End", *4 * ("BackSpace",), "2", "period", "o", "f", "f"):
    hand.key_goes(key, True)  # for some frames, as above
    time.sleep(0.1)
    hand.key_goes(key, False)
    time.sleep(0.1)
hand.key_goes("Return", True)
eventually(lambda: os.path.exists(at("saved2.off")), f"another name is taken: {os.listdir(folder)}")
hand.key_goes("Return", False)
time.sleep(0.5)
check(process.poll() is None, "the save after one that was refused does not quit")

hand.close(identity)
try:
    out, err = process.communicate(timeout=PATIENCE)
    check(process.returncode == 0 and err.count("\n") == 1 and f"'{late}' is not opened" in err, f"closing without unsaved work ends: exit {process.returncode}: {err}")
except subprocess.TimeoutExpired:
    process.kill()
    check(False, "closing without unsaved work does not end")
check(not os.path.exists(other + ".log"), "a log that has nothing is removed")
recorded = lines_of(record)
check(recorded[0].endswith(f"a window of {SIZE[0]} x {SIZE[1]}"), f"the recording says how large the window was: {recorded[0]}")
for line in ("press left", "press left shift", "press right", "release", "key u", "key shift+u", "key ctrl+z", "scroll -1", "tool probe", f"open {other}",
             f"save {saved}", "close", "key escape"):
    check(line in recorded, f"the recording has no '{line}': {recorded}")
check(recorded.count("press left") + recorded.count("press left shift") + recorded.count("press right") == recorded.count("release"),
      "what was pressed was released, in the recording, too")

end()
