# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs sculpt_window under Xvfb with brushes, masks, symmetry, objects and remeshing; what it made is known from the meshes it
saved and from its log. Arguments: sculpt, source folder, sculpt_window."""
import collections
import math
import os
import random

from program_runs import PATIENCE, SOURCE, bytes_of, check, end, points, run, surface
from window_runs import at, pixels_of, read_png, replayed, window

BALL_AND_MOON = os.path.join(SOURCE, "examples/data/ball_and_moon.off")
BALL = at("sculpt_window_ball.off")


faces = lambda path: surface(path)[1]


def is_valid(path, what):
    done = run(path)
    check(done.returncode == 0, f"{what}: not a valid surface: {done.stderr}")


# Without a mesh there is a ball, written once; what is not saved is made again from its log.
lines, _ = window("--samples", 0, "--size", 300, 225, script="settle\nprint\nquit\n", what="no mesh")
check(lines[0]["faces"] == 8 * 71 ** 2 and os.path.exists(BALL) and not os.path.exists(BALL + ".log"), f"a ball of its own: {lines}")
is_valid(BALL, "the ball")
place = {p: i for i, p in enumerate(points(BALL))}
flipped = lambda p, axis: tuple(-x if k == axis else x for k, x in enumerate(p))
check(all(flipped(p, axis) in place for p in place for axis in range(3)), "the ball is its own mirror image, to the bit")
check(all(abs(math.hypot(*p) - 1) < 1e-15 for p in place), "the ball has radius 1")
# Larger than what is drawn at once: from both sides a disk without a hole, and half of it where the window cuts it off.
window(BALL, "--samples", 0, "--no-log", "--size", 300, 300, script=f"""
key tab
tool drag
view 1 1 1
settle
screenshot {at('front.png')}
view -1 -1 -1
settle
screenshot {at('back.png')}
drag 150 150 0 150 1 middle
move 299 5
settle
screenshot {at('cut.png')}
quit
""", what="the ball from two sides")


def disk(name):
    """How many pixels are not the background; those of a row have no gap."""
    seen = 0
    for row in read_png(at(name))[1]:
        pixels = [row[x:x + 3] for x in range(0, len(row), 3)]
        columns = [x for x, pixel in enumerate(pixels) if pixel != bytes((41, 46, 54))]
        check(not columns or columns[-1] - columns[0] + 1 == len(columns), f"{name}: a hole in the ball")
        seen += len(columns)
    return seen


front = disk("front.png")
check(front > 30000 and abs(disk("back.png") - front) < 100, f"the ball is seen whole from both sides: {front}")
# From aside a ball of radius 1 looks a little smaller.
check(0.95 * front / 2 < disk("cut.png") < front / 2, "half of the ball is in the window")
before = bytes_of(BALL)
lines, _ = window("--samples", 0, "--size", 300, 225, script="settle\nclick 150 112\nsettle\nprint\nquit\n", what="the ball again")
check(lines[0]["edits"] > 0 and bytes_of(BALL) == before, f"a ball that is there is opened: {lines}")
lines, _ = window("--samples", 0, "--size", 300, 225, script="settle\nkey u\nsettle\nprint\nquit\n", what="the ball's log")
check(lines[0]["redo"] == 1 and lines[0]["undo"] == 0, f"what was not saved is there again, and is undone: {lines}")
os.remove(BALL + ".log")

SEEN = (-0.38, 0.76, -0.53)  # a direction of view, and about it:
PLACE = (0.45, -0.75, 0.48)  # on the ball, seen, off all planes of symmetry
spot = lambda p: "@" + ",".join(map(repr, p))
on_ball = lambda p: tuple(x / math.hypot(*p) for x in p)
HEAD = f"view {SEEN[0]} {SEEN[1]} {SEEN[2]}\nkey tab\nsettle\n"


def sculpted(script, what, mesh=BALL, *options):
    """\\return the points before, and after, and the states printed"""
    out, log = at("out.off"), at("work.log")
    for path in (out, log):
        if os.path.exists(path):
            os.remove(path)
    lines, _ = window(mesh, "--log", log, "--samples", 0, "--size", 400, 400, *options,
                      script=HEAD + script + f"settle\nprint\nsave {out}\nsettle\nquit\n", what=what)
    replayed(mesh, log, out, what)
    return points(mesh), points(out), lines


# A mask holds what it covers still, to the bit, and is seen; without it the same dabs move all.
centre = on_ball(PLACE)
dabs = f"brush inflate 0.5 1\nclick {spot(centre)}\nclick {spot(centre)}\nbrush grab 0.5\ndrag {spot(centre)} {spot(on_ball((0.6, -0.7, 0.4)))} 4\n"
before, after, _ = sculpted(f"screenshot {at('bare.png')}\nbrush mask 0.3 1\nclick {spot(centre)}\nsettle\ntool drag\nmove 5 5\nscreenshot {at('masked.png')}\n"
                            + dabs, "a mask")
# 2 (1 - (d / r)^2)^2 >= 1 where d <= 0.541 r; the place that was clicked is within a pixel, 0.01, of the centre.
held = [i for i, p in enumerate(before) if math.dist(p, centre) < 0.541 * 0.3 - 0.01]
ring = [i for i, p in enumerate(before) if 0.32 < math.dist(p, centre) < 0.4]
check(len(held) > 50 and all(before[i] == after[i] for i in held), f"a mask holds {len(held)} vertices still")
check(len(ring) > 50 and all(before[i] != after[i] for i in ring), "beside the mask all moves")
tint = pixels_of(at("masked.png"), 0.63)
check(len(pixels_of(at("bare.png"), 0.63)) == 0 and len(tint) > 1000, f"a mask is seen: {len(tint)} pixels")
_, after, _ = sculpted(f"brush mask 0.3 1\nclick {spot(centre)}\nbrush unmask 0.4 1\nclick {spot(centre)}\n" + dabs, "unmasked")
check(all(before[i] != after[i] for i in held), "what is unmasked moves")
_, after, _ = sculpted(f"brush mask 0.3 1\nclick {spot(centre)}\nkey ctrl+m\n" + dabs, "all unmasked")
check(all(before[i] != after[i] for i in held), "what is unmasked as a whole moves")
_, after, _ = sculpted(f"brush mask 0.3 1\nclick {spot(centre)}\nbrush grab 0.5\nmove {spot(centre)}\nkey d\nremesh 0.05\n", "a mask and remeshing")
kept = set(after)
check(all(before[i] in kept for i in held), "masked vertices stay where they are when it is remeshed")
masked = {before[i] for i in held}
triangles_of = lambda path: {frozenset(corners) for corners in ([p[v] for v in face] for p, found in [surface(path)] for face in found)
                             if masked.issuperset(corners)}
check(len(triangles_of(BALL)) > 50 and triangles_of(BALL) <= triangles_of(at("out.off")), "so do the triangles between them")

# Dabs with symmetry make what is its own mirror image. Sums of a vertex's neighbours are added up in other orders there: some
# ulps of 1 a dab, and some for the place, whose mirror image is rounded.
ROUNDING = 1e-13
for axes in ("x", "y z", "x y z"):
    work = f"symmetry {axes}\n" + "".join(f"brush {kind} 0.3 1\ndrag {spot(centre)} {spot(on_ball((0.5, -0.6, 0.6)))} 3\n"
                                          for kind in ("inflate", "smooth", "flatten", "pinch", "grab"))
    before, after, lines = sculpted(work, f"symmetry {axes}")
    moved = sum(p != q for p, q in zip(before, after))
    check(moved > 1000, f"symmetry {axes}: {moved} vertices moved")
    for axis in range(3):
        apart = max(math.dist(flipped(after[i], axis), after[place[flipped(p, axis)]]) for i, p in enumerate(before))
        check(apart < ROUNDING if "xyz"[axis] in axes else apart > 0.01, f"symmetry {axes}: mirrored in {'xyz'[axis]} it is {apart} off")

# The same script does the same, to the bit, whatever the clock says.
work = f"brush inflate 0.2 1\ndrag {spot(centre)} {spot(on_ball((0, -0.8, 0.6)))} 12\nbrush smooth 0.3\ndrag {spot(centre)} {spot(on_ball((0, -0.8, 0.6)))} 12 ctrl\n"
first, second = sculpted(work, "a script")[1], sculpted(work, "a script again")[1]
check(first == second, "a script makes the same again")

# Triangles keep up: under the brush by a key, everywhere by a line, or as the brush goes; each is one step of undo.
before, after, lines = sculpted(f"brush inflate 0.2 1\nmove {spot(centre)}\nkey d\nsettle\nprint\nkey u\nsettle\nprint\nkey shift+u\nsettle\n", "remeshed here")
near = lambda places, r: sum(math.dist(p, centre) < r for p in places)
check(near(after, 0.15) > 1.5 * near(before, 0.15), "triangles under the brush are as small as it needs")
check(set(p for p in before if math.dist(p, centre) > 0.22) <= set(after), "what is not under the brush stays as it was")
check(lines[1]["faces"] == 8 * 71 ** 2 and lines[1]["undo"] == 0 and lines[0]["faces"] == lines[2]["faces"], f"remeshing is one step: {lines}")
_, after, _ = sculpted(f"symmetry x\nbrush inflate 0.2 1\nmove {spot(centre)}\nkey d\n", "remeshed on both sides")
other = flipped(centre, 0)
check(sum(math.dist(p, other) < 0.15 for p in after) > 1.5 * near(before, 0.15), "remeshed on the other side, too")
_, after, _ = sculpted("remesh 0.06\n", "remeshed everywhere")
mesh = faces(at("out.off"))
lengths = sorted(math.dist(after[a], after[b]) for f in mesh for a, b in zip(f, f[1:] + f[:1]))
check(0.05 < lengths[len(lengths) // 2] < 0.07 and lengths[-1] < 0.1, f"edges as long as asked for: {lengths[len(lengths) // 2]}, at most {lengths[-1]}")
before, after, lines = sculpted(f"key ctrl+d\nbrush inflate 0.15 1\ndrag {spot(centre)} {spot(on_ball((0.3, -0.8, 0.5)))} 18\n", "remeshed as it goes")
check(lines[0]["faces"] > 8 * 71 ** 2 + 500 and lines[0]["undo"] == 1, f"triangles keep up with the brush: {lines}")

# An object is moved as it is, up to what is in its way. The moon is a component of its own.
edges = collections.defaultdict(list)
for f in faces(BALL_AND_MOON):
    for a, b in zip(f, f[1:] + f[:1]):
        edges[a].append(b)
reached, last = {0}, [0]
while last:
    last = [w for v in last for w in edges[v] if w not in reached and not reached.add(w)]
places = points(BALL_AND_MOON)
moon = [i for i in range(len(places)) if i not in reached] if len(reached) * 2 > len(places) else sorted(reached)
middle = tuple(sum(places[i][k] for i in moon) / len(moon) for k in range(3))
FROM_ABOVE = f"view 0 0 -1\nsettle\ntool object\n"
aside = tuple(m + 0.4 * d for m, d in zip(middle, on_ball((*middle[:2], 0))))
top = max(places[i][2] for i in moon)
for goal, is_free in ((aside, True), ((0, 0, middle[2]), False)):
    before, after, lines = sculpted(FROM_ABOVE + f"drag {spot((*middle[:2], top))} {spot((*goal[:2], top))} 6\n", f"the moon to {goal}", BALL_AND_MOON)
    way = tuple(b - a for a, b in zip(before[moon[0]], after[moon[0]]))
    check(all(before[i] == after[i] for i in range(len(before)) if i not in set(moon)), "the other object stays")
    check(math.hypot(*way) > 0.05 and all(math.dist(tuple(b - a for a, b in zip(before[i], after[i])), way) < ROUNDING for i in moon),
          f"the moon moves as one: {way}")
    check((math.dist(way, tuple(b - a for a, b in zip(middle, goal))) < 0.05) == is_free, f"as far as it is free: {way}, {goal}")
    check(lines[0]["undo"] == 1, f"one step of undo: {lines}")
    is_valid(at("out.off"), "moved objects")
    # Its log has shifts of the whole moon, in one stroke; before them stand four lines of the head.
    log = [line.split("#")[0].split() for line in open(at("work.log")) if line.split("#")[0].strip()][4:]
    check({line[0] for line in log if line[0].isalpha()} == {"stroke", "shift", "end"},
          f"what is logged of it: {log[:9]}")
    check(max(int(line[2]) for line in log if line[0] == "shift") == len(moon), "shifts of the whole moon")

# Colours of the mesh's file are in what is saved, also of vertices that are new.
ply = at("coloured.ply")
with open(ply, "w") as file:
    shape = faces(BALL_AND_MOON)
    file.write(f"ply\nformat ascii 1.0\nelement vertex {len(places)}\n" + "".join(f"property double {x}\n" for x in "xyz")
               + "".join(f"property uchar {c}\n" for c in ("red", "green", "blue")) + f"element face {len(shape)}\nproperty list uchar int vertex_indices\nend_header\n")
    file.write("".join("%r %r %r 200 %d 7\n" % (*p, i % 256) for i, p in enumerate(places)) + "".join("3 %d %d %d\n" % tuple(f) for f in shape))
window(ply, "--no-log", "--samples", 0, "--size", 300, 225, script=f"settle\ntool create\ndrag 160 130 175 107 3\nsave {at('saved.ply')}\nsave {at('saved.off')}\nsettle\nquit\n", what="colours")
run(at("saved.ply"), "-o", at("words.ply"))
text = bytes_of(at("saved.ply"))
check(b"uchar red" in text.split(b"end_header")[0], "colours are saved")
check(len(points(at("saved.off"))) == len(places) + 1, "a file that holds no colours is written, too")

# The head of the README, by brushes alone.
CREATURE = open(os.path.join(SOURCE, "examples/data/creature.window-script")).read()
lines, _ = window(BALL, "--no-log", "--samples", 0, "--size", 320, 200, script=CREATURE + f"settle\nprint\nsave {at('head.off')}\nsettle\nquit\n",
                  what="a head", patience=8 * PATIENCE)
is_valid(at("head.off"), "a head")
head = points(at("head.off"))
check(lines[0]["faces"] > 8 * 71 ** 2 + 5000 and lines[0]["undo"] > 15, f"a head has more triangles where it needs them: {lines}")
check(max(p[2] for p in head) > 1.3 and min(p[1] for p in head) < -1.3 and min(p[2] for p in head) < -1.05, "a head has ears, a snout and a chin")

# Whatever a hand does, in any order: the log makes the same again, and it is a valid surface.
for seed in range(2):
    chance = random.Random(seed)
    x, y = lambda: chance.randrange(60, 340), lambda: chance.randrange(60, 340)
    script = ""
    for _ in range(40):
        script += chance.choice((
            lambda: f"drag {x()} {y()} {x()} {y()} {chance.randrange(1, 6)} {chance.choice(('', 'normal', 'ctrl', 'right'))}\n",
            lambda: f"brush {chance.choice(('grab', 'inflate', 'smooth', 'flatten', 'pinch', 'mask', 'unmask'))} {chance.choice((0.05, 0.2, 0.6))} {chance.uniform(-1, 1)}\n",
            lambda: f"key {chance.choice(('u', 'shift+u', 'd', 'ctrl+d', 'shift+x', 'shift+y', 'shift+z', 'ctrl+m', 'e', 'c', 't', 'v', 'b', 'escape', 'w', 'f2'))}\n",
            lambda: f"tool {chance.choice(('drag', 'probe', 'create', 'remove', 'brush', 'object'))}\n",
            lambda: f"move {x()} {y()}\n", lambda: f"press left\nmove {x()} {y()}\nkey {chance.choice(('u', 'd', 'escape', '1', 'g'))}\nrelease\n",
            lambda: f"scroll {chance.randrange(-2, 3)} {chance.choice(('', 'ctrl', 'shift'))}\n", lambda: "wait 0.05\n", lambda: f"remesh {chance.choice((0.1, 0.2))}\n"))()
    sculpted(script, f"seed {seed}", BALL_AND_MOON)
    is_valid(at("out.off"), f"seed {seed}")

end()
