#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""What `sculpt` writes, and where: links, rights, full disks, left-over files."""
import fcntl
import json
import os
import shutil
import stat
import subprocess
import tempfile

from box_mesh import box
from program_runs import IS_SANITIZED, PATIENCE, SCULPT, TETRAHEDRON, bytes_of, check, end, fails, run, write


def bad_targets(folder, mesh):
    """What cannot be written is reported, before the work where it can be known, and costs nothing else."""
    kept = f"{folder}/kept.off"
    with open(kept, "w") as file:
        file.write("kept")
    fails(5, [], run(mesh, "-o", kept, limit=64), "disk full")
    check(open(kept).read() == "kept", "a full disk spoils the old file")
    check(not [name for name in os.listdir(folder) if name.startswith("kept.off") and name != "kept.off"], "left-over file")
    fails(5, ["nowhere"], run(mesh, "-o", f"{folder}/nowhere/out.off"), "missing folder of the result")
    fails(5, ["is not a folder"], run(mesh, "--report", f"{mesh}/file"), "a mesh for a folder")
    os.mkdir(f"{folder}/target.off")
    fails(5, ["target.off"], run(mesh, "-o", f"{folder}/target.off"), "the result is a folder")
    for option in ("--report", "--picture"):
        with open(f"{folder}/kept.png", "w") as file:
            file.write("kept")
        fails(5, ["kept.png"], run(mesh, option, f"{folder}/kept.png", limit=64), f"disk full, {option}")
        check(open(f"{folder}/kept.png").read() == "kept", f"a full disk spoils the old file of {option}")
        check(not [name for name in os.listdir(folder) if name.startswith("kept.png") and name != "kept.png"], f"left-over file of {option}")
        fails(5, ["/dev/full"], run(mesh, option, "/dev/full"), f"{option} to a device")
        # Found before the work: the good target is not touched either.
        fails(5, ["nowhere"], run(mesh, "-o", kept, option, f"{folder}/nowhere/file"), f"missing folder of {option} beside a good result")
        check(open(kept).read() == "kept", f"the result is written though {option} cannot be")
    for option in ("--report", "--log"):
        with open(kept, "a") as table:
            script = ["--script", "/dev/null"] if option == "--log" else []
            done = subprocess.run([SCULPT, mesh, option, kept, *script],
                                  stdout=table, stderr=subprocess.PIPE, text=True, timeout=PATIENCE)
        fails(2, ["standard output", option], done, f"{option} where the table goes")
        check(open(kept).read() == "kept", f"{option} where the table goes: {open(kept).read()}")
    with open("/dev/full", "w") as full:
        done = subprocess.run([SCULPT, mesh, "-o", f"{folder}/table.off"], stdout=full,
                              stderr=subprocess.PIPE, text=True, timeout=PATIENCE)
    fails(5, ["standard output"], done, "no room for the table")
    check(os.path.exists(f"{folder}/table.off"), "the result is written before the table")
    fails(5, ["nowhere"], run(mesh, "--report", f"{folder}/nowhere/report.json"), "missing folder of the report")
    fails(5, ["nowhere"], run(mesh, "--picture", f"{folder}/nowhere/picture.png"), "missing folder of the picture")
    done = run(mesh, "--picture", f"{folder}/picture.png")
    check(done.returncode == 0 and open(f"{folder}/picture.png", "rb").read(4) == b"\x89PNG", f"picture: {done.stderr}")


def memory_runs_out(folder, mesh):
    """Where there is enough to read a mesh, but not to write it: all of OUT is written, or nothing, exit code 1."""
    if IS_SANITIZED:
        return
    ball, step = write(f"{folder}/ball.off", box(40)), 1 << 20
    too_little, enough = step, 1 << 30  # to read it
    while enough - too_little > step:
        middle = (too_little + enough) // 2
        too_little, enough = (too_little, middle) if run(ball, memory=middle).returncode == 0 else (middle, enough)
    run(ball, "-o", f"{folder}/sound.stl")
    out, codes = f"{folder}/out.stl", []
    for memory in range(enough, enough + 12 * step, step):
        write(out, "kept")
        done = run(ball, "-o", out, memory=memory)
        codes.append(done.returncode)
        if done.returncode == 0:
            check(bytes_of(out) == bytes_of(f"{folder}/sound.stl"),
                  f"with {memory} bytes of memory a part of OUT is written, and the exit code is 0")
        else:
            fails(1, ["out.stl", "memory"], done, f"with {memory} bytes of memory")
            check(bytes_of(out) == b"kept", f"with {memory} bytes of memory the old file is spoilt")
    check(1 in codes and 0 in codes, f"memory has never run out while OUT is written, or always: {codes}")


def links(folder, mesh):
    expected = f"{folder}/expected.off"
    run(mesh, "-o", expected)
    os.mkdir(f"{folder}/there")
    os.symlink("there/result.off", f"{folder}/first.off")
    os.symlink(f"{folder}/first.off", f"{folder}/second.off")
    for _ in range(2):  # to begin with it leads nowhere
        check(run(mesh, "-o", f"{folder}/second.off").returncode == 0, "a result through links")
        check(os.path.islink(f"{folder}/first.off") and os.path.islink(f"{folder}/second.off"), "the links stay")
        check(bytes_of(f"{folder}/there/result.off") == bytes_of(expected) and os.listdir(f"{folder}/there") == ["result.off"], "where the links lead")
    for option, name in (("--report", "report"), ("--picture", "picture")):
        os.symlink(f"there/{name}", f"{folder}/{name}")
        check(run(mesh, option, f"{folder}/{name}").returncode == 0 and os.path.islink(f"{folder}/{name}") and os.path.exists(f"{folder}/there/{name}"),
              f"{option} through a link that leads nowhere yet")
    for link, to in (("loop.off", "loop.off"), ("a.off", "b.off"), ("b.off", "a.off"), ("nowhere.off", "not_there/x.off")):
        os.symlink(to, f"{folder}/{link}")
        os.symlink(to.replace(".off", ".png"), f"{folder}/{link.replace('.off', '.png')}")
    for link, part in (("loop.off", "circle"), ("a.off", "circle"), ("nowhere.off", "folder")):
        for option in ("-o", "--report", "--picture"):
            report, link = f"{folder}/not_yet.json", link.replace(".off", ".png") if option == "--picture" else link
            fails(5, [link, part], run(mesh, option, f"{folder}/{link}", *([] if option == "--report" else ["--report", report])), f"{option} {link}")
            check(os.path.islink(f"{folder}/{link}") and not os.path.exists(report), f"{option} {link}: found out too late")
    os.symlink("both", f"{folder}/one.json")
    fails(2, ["one file"], run(mesh, "--report", f"{folder}/one.json", "--picture", f"{folder}/both"), "two outputs in one file through a link that leads nowhere")


def for_everybody(folder):
    """The program, where other users reach it: not in a home folder."""
    return shutil.copy(SCULPT, f"{folder}/program")


def rights(folder, mesh):
    out = write(f"{folder}/out.off", "old")
    for before, after in ((0o640, 0o640), (0o4755, 0o755), (0o2775, 0o775), (0o6777, 0o777), (0o600, 0o600)):
        os.chmod(out, before)
        check(run(mesh, "-o", out).returncode == 0, f"over a file of mode {before:o}")
        check(stat.S_IMODE(os.stat(out).st_mode) == after, f"mode {before:o} becomes {stat.S_IMODE(os.stat(out).st_mode):o}, not {after:o}")
    if os.getuid() != 0:
        print("skipped: owners can be given by root only")
        return
    os.chown(out, 12345, 23456)
    done = run(mesh, "-o", out)
    check((os.stat(out).st_uid, os.stat(out).st_gid) == (12345, 23456) and "owner" not in done.stderr, "root keeps the owner")
    # Somebody else who may write the file, and into the folder, but cannot give files away.
    os.chmod(folder, 0o777)
    os.chmod(os.path.dirname(folder), 0o755)
    os.chown(out, 12345, 23456)
    os.chmod(out, 0o676)
    done = run(mesh, "-o", out, "--report", f"{folder}/report.json", program=for_everybody(folder), user=34567)
    check(done.returncode == 0, f"another user: {done.stderr}")
    for part in (out, "owner (user 12345)", "34567", "group (23456)"):
        check(part in done.stderr and any(part in note for note in json.load(open(f"{folder}/report.json"))["notes"]), f"the message does not say {part}: {done.stderr}")
    status = os.stat(out)
    check(status.st_uid == 34567 and stat.S_IMODE(status.st_mode) == 0o666, f"a group comes by rights: mode {stat.S_IMODE(status.st_mode):o}")


def sticky_folder(folder, mesh):
    """Where only its owner may replace a file, that is found before the work."""
    if os.getuid() != 0:
        print("skipped: only root can be somebody else")
        return
    os.chmod(folder, 0o1777)
    os.chmod(os.path.dirname(folder), 0o755)
    out = write(f"{folder}/of_root.off", "kept")
    os.chmod(out, 0o666)
    done = run(mesh, "-o", out, program=for_everybody(folder), user=34567)
    fails(5, ["of_root.off", "owner"], done, "a file of another in a sticky folder")
    check("asked" not in done.stdout, "the work is done before the output is looked at")
    check(open(out).read() == "kept", "the old file is spoilt")


def control_bytes(folder, mesh):
    """No byte that a terminal obeys comes from a name or a script."""
    def is_text(done, what):
        text = done.stdout + done.stderr
        bad = [c for c in text if (ord(c) < 0x20 and c not in "\n\r\t") or 0x7f <= ord(c) < 0xa0]
        check(not bad, f"{what}: {bad} in {text!r}")
        check("\\x" in text, f"{what}: nothing is escaped in {text!r}")

    script = write(f"{folder}/bad\x1b[2J.script", "drag 0 1 1\n")
    is_text(run(mesh, "--script", script), "name of a script")
    is_text(run(mesh, "--response", "\x1b[31m"), "value of an option")
    is_text(run(mesh, "--clearance", "\x7f\x07"), "number of an option")
    is_text(run(mesh, "surplus\x1b]0;title\x07"), "surplus argument")
    is_text(run(mesh, "--script", "/dev/stdin", script="drag 0 \u009b31m 0 0\n"), "control character of two bytes")
    with open(f"{folder}/byte.script", "wb") as file:
        file.write(b"drag 0 \x9b31m 0 0\n")
    is_text(run(mesh, "--script", f"{folder}/byte.script"), "control character of one byte")
    for sequence in (b"\xe0\x82\x9b", b"\xf0\x80\x82\x9b", b"\xed\xa0\x80", b"\xf4\x90\x80\x80"):
        name = os.fsdecode(os.fsencode(folder) + b"/" + sequence + b".script")
        write(name, "drag 0 1 1\n")
        is_text(run(mesh, "--script", name), f"a name with {sequence}, which is no character")
    umlaut = write(f"{folder}/räume.script", "drag 0 1 1\n")
    check("räume" in run(mesh, "--script", umlaut).stderr, "letters beyond ASCII are shown")


def left_over_files(folder, mesh):
    """Temporary files of dead processes go, those of living ones stay, and so does everything else."""
    dead = subprocess.Popen(["true"])
    dead.wait()
    left = [write(f"{folder}/.{name}.haptic_sculpt-new-{dead.pid}-{i}", "half") for i, name in enumerate(("out.off", "other.ply", "report.json"))]
    # The number of a living process says nothing: numbers are given again.
    left.append(write(f"{folder}/.out.off.haptic_sculpt-new-{os.getpid()}-0", "half"))
    others = [write(f"{folder}/{name}", "mine") for name in ("out.off.haptic_sculpt-new-1-1", ".out.off.haptic_sculpt-new-1", ".haptic_sculpt-new-x-1", ".x")]
    os.mkdir(f"{folder}/.folder.haptic_sculpt-new-1-1")
    living = write(f"{folder}/.out.off.haptic_sculpt-new-{os.getpid()}-1", "half")
    with open(living) as file:
        fcntl.flock(file, fcntl.LOCK_EX)
        check(run(mesh, "-o", f"{folder}/out.off").returncode == 0, "beside left-over files")
        check(not any(map(os.path.exists, left)), f"left-over files stay: {os.listdir(folder)}")
        check(os.path.exists(living), "the temporary file of a living process is removed")
        check(all(map(os.path.exists, others)) and os.path.isdir(f"{folder}/.folder.haptic_sculpt-new-1-1"), "other files are removed")
    run(mesh, "--report", f"{folder}/report.json")
    check(not os.path.exists(living), "it stays when its process has died")


def hostile_inputs(folder, mesh):
    """What has no end, or is larger than it may be, is refused before it is read."""
    endless = f"{folder}/endless.off"
    os.symlink("/dev/zero", endless)
    for options in ([], ["--log", f"{folder}/endless.log"]):
        fails(3, ["not a regular file"], run(endless, *options, seconds=PATIENCE / 6), f"a mesh without end {options}")
    with open(f"{folder}/hole.log", "wb") as hole:
        hole.truncate(1 << 36)
    done = run(mesh, "--log", f"{folder}/hole.log", seconds=PATIENCE / 6)
    fails(6, ["is not a log"], done, "a log of 64 GiB of nothing")
    head = "ply\nformat ascii 1.0\nelement vertex 3\n"
    for line, number, part in (("property float p{}\n", 1001, "1000 properties"), ("element e{} 0\n", 1000, "1000 elements")):
        many = write(f"{folder}/many.ply", head + "".join(line.format(i) for i in range(number)))
        fails(3, [part], run(many), f"more than {part}")
    fails(5, ["too long"], run(mesh, "-o", f"{folder}/{'a' * 300}.off"), "a name that is too long")
    fails(2, ["--repair-largest-hole"], run(mesh, "--repair", "--repair-largest-hole", "-1"), "less than no edges")


def main():
    with tempfile.TemporaryDirectory() as folder:
        mesh = write(f"{folder}/tetrahedron.off", TETRAHEDRON)
        os.chmod(mesh, 0o644)
        for part in (bad_targets, memory_runs_out, links, rights, sticky_folder, control_bytes, left_over_files,
                     hostile_inputs):
            inner = f"{folder}/{part.__name__}"
            os.mkdir(inner)
            part(inner, mesh)
    end()


main()
