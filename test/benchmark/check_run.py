#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""check_run.py ROOT BUILD PROGRAM ...: `benchmark/run --tiny` ends with a page that holds all it shows.

It is killed and goes on; a program that dies is named, made again, and can be run alone; a mesh of the user's that is
refused is listed with its reason; answers of another program make a row. Where chromium is, it draws the page."""
import base64
import json
import os
import pathlib
import re
import resource
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from html.parser import HTMLParser

ROOT, BUILD = (pathlib.Path(word).resolve() for word in sys.argv[1:3])
PYTHON = "/usr/bin/python3"  # Debian's, which has its packages
STEPS = ["axis", "device", "drags_and_edits"]
faults = []


def expect(condition, fault):
    if not condition:
        faults.append(fault)


def run(out, *arguments, build=BUILD):
    return subprocess.run([PYTHON, str(ROOT / "benchmark/run"), "--tiny", "--no-build", "--build", str(build), "--out", str(out), "--cores", "1", *arguments],
                          capture_output=True, text=True)


class Page(HTMLParser):
    """Images, and addresses that would be fetched."""

    def __init__(self, text):
        super().__init__()
        self.images, self.fetched, self.text = [], [], text
        self.feed(text)

    def handle_starttag(self, tag, attrs):
        attrs = dict(attrs)
        if tag == "img":
            self.images.append(attrs)
        for name in ("src", "href"):
            if name in attrs and not attrs[name].startswith(("data:", "#")):
                self.fetched.append(attrs[name])


def check_page(out):
    page = Page((out / "index.html").read_text())
    expect(len(page.images) >= len(STEPS), f"{len(page.images)} images of {len(STEPS)} steps")
    expect(not page.fetched, f"the page fetches {page.fetched}")
    for image in page.images:
        svg = base64.b64decode(image["src"].split(",", 1)[1]).decode()
        expect(image.get("alt"), "an image has no words")
        expect(svg.count("<path") > 10 and svg.rstrip().endswith("</svg>"), f"the image '{image.get('alt')}' is empty or cut off")
    about = json.loads((out / "run.json").read_text())
    for key in ("machine", "compiler", "commit", "seed"):
        expect(str(about[key]) and str(about[key]) in page.text.replace("&#43;", "+"), f"the page does not tell the {key}: {about[key]!r}")
    if chromium := shutil.which("chromium"):
        picture = out / "page.png"
        subprocess.run([chromium, "--headless", "--no-sandbox", "--disable-gpu", "--hide-scrollbars", "--window-size=1000,2400", f"--screenshot={picture}",
                        f"file://{out / 'index.html'}"], capture_output=True, timeout=120)
        expect(picture.exists() and picture.stat().st_size > 50000, "chromium draws nothing, or hardly anything")
    return page


def still_working(build):
    """Processes that have the folder of a build on their command line."""
    found = []
    for path in pathlib.Path("/proc").glob("[0-9]*/cmdline"):
        try:
            words = path.read_bytes()
        except OSError:  # it has ended
            continue
        if os.fsencode(str(build)) in words:
            found.append(words.replace(b"\0", b" ").decode(errors="replace"))
    return found


def killed_by_itself(out, folder):
    """What it has started ends with it."""
    build = folder / "sleeping"
    program = build / "benchmark/axis_speed_error"
    program.parent.mkdir(parents=True)
    program.write_text("#!/usr/bin/python3\nimport time\ntime.sleep(600)\n")
    program.chmod(0o755)
    going = subprocess.Popen([PYTHON, str(ROOT / "benchmark/run"), "--tiny", "--no-build", "--build", str(build),
                              "--out", str(out), "axis"], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    end = time.monotonic() + 300
    while time.monotonic() < end and not any(str(program) in words for words in still_working(build)):
        time.sleep(0.1)
    expect(len(still_working(build)) >= 3, f"it did not begin: {still_working(build)}")
    going.kill()
    going.wait()
    end = time.monotonic() + 60
    while time.monotonic() < end and still_working(build):
        time.sleep(0.1)
    expect(not still_working(build), f"after a kill these go on: {still_working(build)}")
    # A shard whose parent has ended before it begins.
    shard = [PYTHON, str(ROOT / "benchmark/common/run_step.py"), "axis", "0", "1", "--mode", "tiny"]
    done = subprocess.run([*shard, "--build", str(build), "--json", str(folder / "late.json"), "--parent", "1"],
                          capture_output=True)
    expect(done.returncode == -signal.SIGKILL, f"a shard without its parent: {done.returncode}, {done.stderr}")


def kill_and_resume(out):
    """Killed by itself, once three reports are there, of which two must not be made again; the same command goes on."""
    going = subprocess.Popen([PYTHON, str(ROOT / "benchmark/run"), "--tiny", "--no-build", "--build", str(BUILD), "--out", str(out), "--cores", "1", *STEPS],
                             stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, start_new_session=True)
    end = time.monotonic() + 1800  # under sanitizers a report takes minutes
    while time.monotonic() < end and going.poll() is None and len(list(out.glob("shards/*/*.json"))) < 3:
        time.sleep(0.02)
    os.kill(going.pid, signal.SIGKILL)
    going.wait()
    before = {path: path.stat().st_mtime_ns for path in out.glob("shards/*/*.json")}
    expect(before, "nothing was done before the kill")
    done = run(out, *STEPS)
    expect(done.returncode == 0, f"after the kill: exit {done.returncode}\n{done.stdout}{done.stderr}")
    steps = re.findall(r"(\d+) of (\d+) steps", done.stdout)
    expect(steps and steps[-1][0] == steps[-1][1], f"it does not say how far it is: {done.stdout}")
    complete = [path for path in before if path.stat().st_mtime_ns == before[path]]
    expect(len(complete) >= 2, f"of {len(before)} reports before the kill {len(before) - len(complete)} were made again")
    return done


def damaged(out):
    """A report, a note or a result that is cut off is made again by the same command, each of another step."""
    names = ("shards/axis/0_of_1.json", "shards/drags_and_edits/0_of_3.note", "results/device.json")
    for name in names:
        (out / name).write_text((out / name).read_text()[:100])
    done = run(out, *STEPS)
    for name in names:
        is_whole = done.returncode == 0 and json.loads((out / name).read_text())
        expect(is_whole, f"{name} cut off: exit {done.returncode}, {done.stderr[-500:]}")


def pictures(out, folder):
    """The manual's pictures are the page's figures."""
    (folder / "pictures").mkdir()
    done = subprocess.run([PYTHON, str(ROOT / "benchmark/common/make_page.py"), str(out), "--pictures", str(folder / "pictures")], capture_output=True, text=True)
    made = sorted(p.name for p in (folder / "pictures").iterdir())
    expect(made == ["device_models.png", "device_speed_error.png"],
           f"pictures of axis, device, drags and edits: {made}, {done.stderr}")
    for name in made:
        expect((folder / "pictures" / name).read_bytes()[:8] == b"\x89PNG\r\n\x1a\n", f"{name} is no picture")


def wrong_use(folder):
    none = str(folder / "none")
    for option, value, said in (("--cores", "0", "--cores"), ("--minutes", "nan", "--minutes"),
                                ("--minutes", "-1", "--minutes"), ("--shards", "-1", "--shards"),
                                ("--shards", "1000000000", "10000"), ("--pictures", "/proc", "can be written to"),
                                ("--seed", "-5", "--seed"), ("--seed", "99999999999999999999", "--seed"),
                                ("--seed", str(2**64 // 1000 - 1), "--seed"),  # a shard would get more than 2^64
                                ("axis", "edits", "--tiny has nothing of edits"),
                                ("--build", none, "no folder with a build"),
                                ("--build", str(folder), "there is no program"),
                                ("--profile", "nosuch", "no profile nosuch"),
                                ("--profile", str(folder), "config.yaml"), ("--answers", none, "there is no file"),
                                ("--out", "", "empty"), ("--out", "/dev/null/x", "cannot make the folder")):
        done = run(folder / "wrong", "device", option, value)
        text = f"{option} {value}: exit {done.returncode}, {done.stderr[-500:]}"
        expect(done.returncode == 2 and said in done.stderr.splitlines()[-1], text)
    listed = run(folder / "wrong", "edits", "--list")
    expect(listed.returncode == 0 and "edits " in listed.stdout, f"edits --list: {listed.stderr}")


def options_are_known():
    """Every program takes what its steps give it, in every mode."""
    sys.path.insert(0, str(ROOT / "benchmark/common"))
    import steps
    for step in steps.all_steps().values():
        if step.promise:  # a test
            continue
        text = subprocess.run([str(BUILD / "benchmark" / step.program), "--help"], capture_output=True, text=True).stdout
        efforts = " ".join(step.effort(mode).options for mode in steps.MODES if step.effort(mode))
        for option in {"--json", "--shard", *re.findall("--[a-z-]+", f"{efforts} {step.with_meshes} {step.with_repair}")}:
            expect(re.search(f"{option}(?![a-z-])", text), f"{step.program} of step {step.name} has no {option}")


def no_case_is_left_out():
    """Of a step that is given a number of cases the shards try no fewer, and say how many."""
    sys.path.insert(0, str(ROOT / "benchmark/common"))
    import run_step
    import steps
    for step in [s for s in steps.all_steps().values() if s.count]:
        for mode, count in step.count.items():
            for shards in (1, 3, 48, step.effort(mode).shards):
                share = steps.share_of(step, mode, shards)
                given = steps.command_of(step, mode, 0, shards, "", "", 1, "")[1]
                told = run_step.report_of_exit(step, 0, shards, 0, share)["promises"][0]["asked"]
                expect(count <= shards * share < count + shards and str(share) in given.values() and told == share,
                       f"{step.name}, {mode}: {shards} shards of {share} for {count}")


def little_time(out):
    """What does not fit is listed, and made by the same command with more time."""
    little = run(out, "axis", "device", "--minutes", "0.0001")
    page = (out / "index.html").read_text()
    expect(little.returncode == 0 and "did not fit: 0/3, 1/3, 2/3 of 3" in page, f"too little time: exit {little.returncode}, {little.stderr}")
    expect("did not fit into --minutes 0.0001: device, nothing of it" in little.stderr, f"it does not say that nothing fitted: {little.stderr}")
    enough = run(out, "axis", "device", "--minutes", "5")
    expect(enough.returncode == 0 and "did not fit" not in (out / "index.html").read_text(), f"enough time: exit {enough.returncode}, {enough.stderr}")
    # An hour of one shard counts where a resumed run lacks another, but not for another seed or number of shards.
    note = out / "shards/device/0_of_3.note"
    note.write_text(json.dumps({**json.loads(note.read_text()), "seconds": 3600}))
    for lost in ("shards/device/2_of_3.json", "results/device.json"):
        (out / lost).unlink()
    for arguments, is_used_up in (((), True), (("--shards", "4"), False), (("--seed", "2"), False)):
        done = run(out, "device", "--minutes", "5", *arguments)
        expect(done.returncode == 0 and ("did not fit" in (out / "index.html").read_text()) == is_used_up,
               f"5 minutes beside an hour, {arguments}: exit {done.returncode}, {done.stderr}")


def own_minutes(out):
    """A program that hangs has died where its step's minutes are up, and has only not fitted where `--minutes` are."""
    out.mkdir()
    asked = f"""import sys
sys.path.insert(0, {str(ROOT / "benchmark/common")!r})
import run_step, steps
steps.all_steps = lambda: {{"hang": steps.Step("hang", "sleep", folder="", tiny=steps.Effort("60", 0.005), promise="it ends")}}
sys.exit(run_step.main())"""
    for bound, code, said in (("0", 1, "had not ended after its 0.005 minutes"), ("1", 1, "had not ended"), ("0.004", 0, "")):
        done = subprocess.run([PYTHON, "-c", asked, "hang", "0", "1", "--mode", "tiny", "--build", "/bin", "--json", str(out / "0_of_1.json"), "--minutes", bound],
                              cwd=out, capture_output=True, text=True)
        expect(done.returncode == code and said in done.stderr and (out / "0_of_1.json").exists() == (code == 0),
               f"it hangs, --minutes {bound}: exit {done.returncode}, {done.stderr}")


def missing_part():
    """A report may lack what its chart shows where a shard did not fit: there is no chart. Else it is a fault."""
    asked = f"""import sys
sys.path.insert(0, {str(ROOT / "benchmark/common")!r})
import make_page
print(make_page.findings("quality", {{"force": {{"did_not_fit": 5, "knocks": {{}}}}}}, []))
without_rows = {{"simplification": "rows", "functions": "comparisons", "whole_drags": "scripts", "many_vertices": "rows"}}
print(make_page.findings("quality", {{name: {{"did_not_fit": 3, "share": 0.5, rows: []}} for name, rows in without_rows.items()}}, []))
make_page.findings("quality", {{"force": {{"knocks": {{}}}}}}, [])"""
    done = subprocess.run([PYTHON, "-c", asked], capture_output=True, text=True)
    expect(done.stdout == "[]\n[]\n", f"charts of forces without the rate, and without rows: {done.stdout}{done.stderr}")
    expect("KeyError: 'rate'" in done.stderr, f"a whole report that lacks its rate is taken: {done.stderr}")


def death(out, folder):
    """A program that dies in one shard is named, made again, and the page is there."""
    build = folder / "build"
    (build / "benchmark").mkdir(parents=True)
    for name in ("axis_speed_error", "device_speed_error"):
        os.symlink(BUILD / "benchmark" / name, build / "benchmark" / name)
    (build / "CMakeCache.txt").write_text((BUILD / "CMakeCache.txt").read_text())
    dying = build / "benchmark" / "device_speed_error"
    dying.unlink()
    dying.write_text(f"#!/bin/bash\n[[ \"$*\" == *'--shard 1/3'* ]] && kill -SEGV $$\nexec {BUILD / 'benchmark' / 'device_speed_error'} \"$@\"\n")
    dying.chmod(0o755)
    done = run(out, "axis", "device", build=build)
    said = [line for line in done.stderr.splitlines() if line.startswith("died: ")]
    expect(done.returncode == 1, f"a program that dies: exit {done.returncode}")
    expect(len(said) == 1 and "device, shard 1/3, was ended by signal 11" in said[0], f"what died is not named: {done.stderr}")
    expect(len((out / "shards/device/1_of_3.failed").read_text().splitlines()) == 2, "it was not made again")
    page = (out / "index.html").read_text()
    expect("shard 1/3, was ended by signal 11" in page, "the page does not tell of it")
    expect((out / "results/axis.json").exists(), "the other step has not gone on")
    if said:
        alone = said[0].rsplit(": ", 1)[1].replace(str(build), str(BUILD))
        expect(subprocess.run(alone, shell=True, cwd=out, capture_output=True).returncode == 0, f"it cannot be run alone: {alone}")
    named = out / "shards/device/1_of_3.failed"
    kept = named.read_text()
    named.write_text("")  # a full disk may leave it so
    emptied = subprocess.run([PYTHON, "-c", f"import pathlib, sys; sys.path.insert(0, {str(ROOT / 'benchmark/common')!r}); import results; "
                              f"print(results.deaths(pathlib.Path({str(out)!r}), ['device']))"], capture_output=True, text=True)
    expect("shard 1/3, was ended from outside" in emptied.stdout, f"a death without words: {emptied}")
    named.write_text(kept)
    dying.write_text(f"#!/bin/bash\nexec {BUILD / 'benchmark' / 'device_speed_error'} \"$@\"\n")
    mended = run(out, "axis", "device", build=build)
    expect(mended.returncode == 0 and "made again: 1/3" in (out / "index.html").read_text(), f"mended, it ends with {mended.returncode}: {mended.stderr}")


BREAKING = """#!/usr/bin/python3
import json, os, sys
given = dict(zip(sys.argv[1:], sys.argv[2:]))
if given["--shard"] == "1/2":
    os.abort()
promises = [{"exit": 10, "promise": "nothing is crossed", "asked": 100, "broken": 7, "may": 0}]
json.dump({"shard": given["--shard"], "scripts": [], "promises": promises, "exit": 10}, open(given["--json"], "w"))
sys.exit(10)
"""


def broken_beside_a_death(out, folder):
    """A promise that one shard has seen broken is named where another dies. What a run of 7 shards has dumped is not listed."""
    program = folder / "breaking/benchmark/drag_speed_error"
    program.parent.mkdir(parents=True)
    program.write_text(BREAKING)
    program.chmod(0o755)
    old = out / "failures/whole_drags/0_of_7/batch_1.script"
    old.parent.mkdir(parents=True)
    old.write_text("drag 0 1 1 1\n")
    done = run(out, "whole_drags", build=folder / "breaking")
    expect(done.returncode == 4 and "broken: whole_drags: nothing is crossed: 7 of 100 not" in done.stderr and "died: whole_drags, shard 1/2" in done.stderr,
           f"a broken promise beside a death: exit {done.returncode}, {done.stderr}")
    page = (out / "index.html").read_text()
    expect("1 broken promises" in page and "nothing is crossed" in page, "the page does not tell of the promise broken beside a death")
    expect("batch_1" not in page, "the page lists a case of another number of shards")


TELLING = """#!/usr/bin/python3
import json, os, pathlib, sys
given = dict(zip(sys.argv[1:], sys.argv[2:]))
names = sorted(path.name for path in pathlib.Path(given["--meshes"]).iterdir())
row = {"unit": 0, "scene": "none", "drags": 1, "mean_distance_left": 1, "judged": 1, "at_minimum": 1, "mean_legs": 1, "mean_ns": 1, "median_ns": 1}
chart = [{**row, "response": name} for name in ("slide", "stop", "paper")]
json.dump({"shard": given["--shard"], "names": names, "chart": chart}, open(given["--json"], "w"))
if "c.off" in names:
    os.rename(given["--meshes"] + "/c.off", given["--meshes"] + "/d.off")
"""


def changed_meshes(out, folder):
    """Where the folder of meshes has changed, its steps are made again, and they alone; a shard that finds others has died."""
    program, meshes = folder / "telling/benchmark/response_quality", folder / "changing"
    program.parent.mkdir(parents=True)
    os.symlink(BUILD / "benchmark/axis_speed_error", program.parent / "axis_speed_error")
    program.write_text(TELLING)
    program.chmod(0o755)
    meshes.mkdir()
    reports = []
    for name in ("a.off", "b.off", "c.off"):
        (meshes / name).write_text("OFF")
        done = run(out, "axis", "responses", "--meshes", str(meshes), build=folder / "telling")
        reports.append([json.loads(path.read_text()) for path in sorted(out.glob("shards/responses/*.json"))])
        if name == "a.off":
            axis = (out / "shards/axis/0_of_1.json").stat().st_mtime_ns
    names = [[r["names"] for r in of_run] for of_run in reports[:2]]
    expect(names == [[["a.off"]] * 2, [["a.off", "b.off"]] * 2], f"shards have read {names}")
    expect((out / "shards/axis/0_of_1.json").stat().st_mtime_ns == axis, "a step without meshes is made again for a mesh")
    expect(done.returncode == 1 and re.search("died: responses, shard ./2, found other meshes", done.stderr), f"changed meanwhile: exit {done.returncode}, {done.stderr}")
    sys.path.insert(0, str(ROOT / "benchmark/common"))
    import merge_shards
    try:
        merge_shards.merge([reports[0][0], {**reports[1][1], "names": ["a.off"]}])
        faults.append("shards of two contents of the folder are merged")
    except merge_shards.Odd_shards as odd:
        expect("meshes_digest" in str(odd), f"refused for another reason: {odd}")


def own_meshes(out, folder):
    """What is refused, or cannot be read, is listed with its reason, breaks no promise, and costs the other files nothing."""
    meshes = folder / "somebody's meshes"
    meshes.mkdir()
    points = "0 0 0\n1 0 0\n0 1 0\n0 0 1\n"
    (meshes / "tetrahedron.off").write_text(f"OFF\n4 4 0\n{points}3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n")
    (meshes / "open.off").write_text(f"OFF\n4 3 0\n{points}3 0 2 1\n3 0 1 3\n3 1 2 3\n")
    (meshes / "cut.off").write_text(f"OFF\n4 4 0\n{points}")
    done = run(out, "drags_and_edits", "responses", "--meshes", str(meshes))
    page = (out / "index.html").read_text()
    expect(done.returncode == 0 and not done.stderr, f"a mesh that is refused: exit {done.returncode}, {done.stderr}")
    for reason in ("open.off", "is not a valid surface", "cut.off", "the file ends after 0 of 4 faces"):
        expect(page.count(reason) >= 2 and page.count("Meshes refused") == 2, f"the page does not say of both steps: {reason}")
    log = (out / "shards/drags_and_edits/0_of_3.log").read_text()
    expect(log.startswith("cut.off: refused") and "\ntetrahedron.off: " in log, f"the user's meshes do not come first: {log[:500]}")
    expect("tetrahedron.off" in page, "the page does not list the mesh that is accepted")
    repaired = run(out, "drags_and_edits", "--meshes", str(meshes), "--repair")
    expect(repaired.returncode == 0 and "open.off, repaired" in (out / "index.html").read_text() and "cut.off" in (out / "index.html").read_text(), f"a mesh that is repaired: exit {repaired.returncode}, {repaired.stderr}")
    robustness = [str(BUILD / "benchmark/robustness"), "--meshes", str(meshes), "--drags", "3", "--drags-on-large", "1",
                  "--edits", "3", "--edits-on-large", "1", "--extreme", "0"]
    broken = ["cut.off", "open.off"]
    for refuse, code in ((broken, 0), (["cut.off"], 14), ([*broken, "tetrahedron.off"], 13)):
        told = subprocess.run([*robustness, "--refuse", *refuse], capture_output=True, text=True)
        expect(told.returncode == code, f"told to refuse {refuse}: exit {told.returncode}, not {code}: {told.stderr}")
    others = meshes / "others"  # a name that is no UTF-8, and one of nothing
    others.mkdir()
    shutil.copy(meshes / "tetrahedron.off", others / os.fsdecode(b"m\xf6we.off"))
    (others / "nothing.off").symlink_to("nowhere.off")
    report = meshes / "others.json"
    for program, options in (("robustness", robustness[3:]), ("response_quality", ["--drags", "0", "--sculpt", "5"]),
                             ("guard_for_cgal", ["--quick", "--no-generated", "--no-large", "--no-functions"])):
        command = [str(BUILD / "benchmark" / program), "--meshes", str(others), *options, "--json", str(report)]
        told = subprocess.run(command, capture_output=True)
        expect(told.returncode == 0, f"{program} of odd names: exit {told.returncode}, {told.stderr}")
        expect(b"nothing.off" in told.stdout + told.stderr, f"{program} does not name what is nothing: {told.stdout}")
        json.loads(report.read_text())
    none = [str(BUILD / "benchmark/robustness"), "--drags", "10", "--edits", "0", "--shard", "0/1000000"]
    for options, code in ((["--dump", str(meshes / "cut.off")], 5), (["--dump", "/dev/null/x", "--dump-all"], 5),
                          (["--dump", ""], 2), (["--clearance", "nan"], 2)):
        told = subprocess.run([*none, *options], capture_output=True, text=True)
        text = f"robustness {options}: exit {told.returncode}, not {code}: {told.stderr}"
        expect(told.returncode == code and told.stderr, text)
    with open("/dev/full", "w") as full:
        told = subprocess.run(none, stdout=full, stderr=subprocess.DEVNULL)
        expect(told.returncode == 5, f"a table that nobody can read: exit {told.returncode}")
    report.unlink()
    reader, writer = os.pipe()
    os.close(reader)
    told = subprocess.run([*none, "--json", str(report)], stdout=writer, stderr=subprocess.PIPE)
    os.close(writer)
    expect(told.returncode == 5 and report.exists(), f"a reader who has gone: exit {told.returncode}, {told.stderr}")
    report.write_text("kept")
    limit = lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (100, 100))
    told = subprocess.run([*none, "--json", str(report)], capture_output=True, preexec_fn=limit)
    expect(told.returncode == 5 and report.read_text() == "kept", f"no room for a report: exit {told.returncode}, {told.stderr}")


PLANTED_ROBUSTNESS = """#!/usr/bin/python3
import json, pathlib, shutil, subprocess, sys
given = dict(zip(sys.argv[1::1], sys.argv[2::1]))
subprocess.run([REAL, "--drags", "3", "--edits", "3", "--seed", given["--seed"], "--json", given["--json"], "--shard", given["--shard"]], check=True)
if given["--shard"] != BROKEN:
    sys.exit(0)
pathlib.Path(given["--dump"]).mkdir(parents=True)
for suffix in (".off", ".script"):
    shutil.copy(CASE + suffix, given["--dump"])
report = json.load(open(given["--json"]))
report["promises"][0]["broken"], report["exit"] = 1, 10
json.dump(report, open(given["--json"], "w"))
sys.exit(10)
"""

# Makes a mesh that crosses itself where the script drags a vertex to x = 7.
PLANTED_SCULPT = """#!/usr/bin/python3
import subprocess, sys
done = subprocess.run([REAL, *sys.argv[1:]])
if done.returncode == 0 and any(line.startswith("drag ") and line.split()[2] == "7" for line in open(sys.argv[sys.argv.index("--script") + 1])):
    out = sys.argv[sys.argv.index("-o") + 1]
    lines = open(out).read().splitlines()
    first = next(i for i, line in enumerate(lines) if len(line.split()) == 3 and not line.startswith("OFF")) + 1
    open(out, "w").write("\\n".join(lines[:first] + ["2 1.5 1.5"] + lines[first + 1:]) + "\\n")
sys.exit(done.returncode)
"""


def failing_case(out, folder):
    """What a program dumps is made small and stands on the page."""
    if not (BUILD / "examples/sculpt").exists():
        print("skipped: failing cases, because sculpt is not built")
        return
    build, case = folder / "planted", folder / "batch_7"
    for program, text in (("benchmark/robustness", PLANTED_ROBUSTNESS), ("examples/sculpt", PLANTED_SCULPT)):
        (build / program).parent.mkdir(parents=True)
        (build / program).write_text(text.replace("REAL", repr(str(BUILD / program))).replace("CASE", repr(str(case))).replace("BROKEN", "'1/3'"))
        (build / program).chmod(0o755)
    (build / "CMakeCache.txt").write_text((BUILD / "CMakeCache.txt").read_text())
    # A tetrahedron and, far from it, a cube: of this only what the fault needs is left.
    corners = [(i & 1, i >> 1 & 1, i >> 2 & 1) for i in range(8)]
    points = [*corners, (40, 0, 0), (41, 0, 0), (40, 1, 0), (40, 0, 1)]
    sides = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)]
    faces = [t for a, b, c, d in sides for t in ((a, b, c), (a, c, d))] + [(8, 10, 9), (8, 9, 11), (9, 10, 11), (8, 11, 10)]
    case.with_suffix(".off").write_text(f"OFF\n{len(points)} {len(faces)} 0\n" + "".join("%d %d %d\n" % p for p in points) + "".join("3 %d %d %d\n" % f for f in faces))
    lines = [f"drag {v} {40.1 + 0.01 * v} 0.1 {0.01 * k}" for k in range(6) for v in (8, 10)]
    case.with_suffix(".script").write_text("\n".join([*lines[:5], "drag 11 7 0 1", *lines[5:]]) + "\n")
    done = run(out, "drags_and_edits", build=build)
    expect(done.returncode == 4 and "fails: drags_and_edits, shard 1/3: " in done.stderr, f"a case that is dumped: exit {done.returncode}, {done.stderr}")
    small = out / "failures/drags_and_edits/1_of_3/batch_7.small.script"
    left = [line for line in small.read_text().splitlines() if not line.startswith("#")] if small.exists() else []
    expect(len(left) == 1 and left[0].split()[2] == "7", f"the case is not made small: {left}")
    page = (out / "index.html").read_text()
    expect("failures/drags_and_edits/1_of_3/batch_7.script" in page and str(small.relative_to(out)) in page, "the page does not list the failing case")
    # A note that was cut off, as by a full disk, is made again.
    small.with_suffix(".txt").write_text("")
    again = run(out, "drags_and_edits", build=build)
    expect(again.returncode == 4 and small.with_suffix(".txt").read_text().endswith(" tries\n"), f"a note that is cut off stays: {again.returncode}, {again.stderr}")
    # Made again by a program that keeps its promises nothing is left of it.
    program = build / "benchmark/robustness"
    program.write_text(program.read_text().replace("'1/3'", "'no shard'"))
    mended = run(out, "drags_and_edits", build=build)
    expect(mended.returncode == 0 and "batch_7" not in (out / "index.html").read_text(), f"mended, it ends with {mended.returncode}: {mended.stderr}")


def status_of_jobs(cluster, forgotten):
    """A job goes on until Slurm says otherwise: where it does not answer, that is no success."""
    script = ROOT / "benchmark/profiles/slurm/slurm_status.sh"
    for said, code, status in ((forgotten, 1, "success"), ("JobState=COMPLETED Reason=None", 0, "success"),
                               ("JobState=TIMEOUT Reason=TimeLimit", 0, "failed"), ("", 1, "running"),
                               ("slurm_load_jobs error: Unable to contact slurm controller", 1, "running"),
                               *((f"   JobState={state} Reason=None", 0, "running")
                                 for state in ("PENDING", "REQUEUE_HOLD", "STAGE_OUT", "SIGNALING", "RESIZING",
                                               "STOPPED"))):
        (cluster / "scontrol").write_text(f"#!/bin/bash\necho '{said}' >&{1 + code}\nexit {code}\n")
        told = subprocess.run([str(script), "17"], capture_output=True, text=True,
                              env={**os.environ, "PATH": f"{cluster}:{os.environ['PATH']}"}).stdout
        expect(told == status + "\n", f"a job of which scontrol says '{said}': {told}")


def few_jobs(out, folder):
    """With a cluster, shards that no longer fit are listed without a job each. Slurm is played by two scripts."""
    cluster = folder / "cluster"
    cluster.mkdir()
    (cluster / "sbatch").write_text(f'#!/bin/bash\necho "$*" >> {cluster}/jobs\nbash "${{!#}}" > {cluster}/log 2>&1\nwc -l < {cluster}/jobs\n')
    forgotten = "slurm_load_jobs error: Invalid job id specified"  # the job has ended
    (cluster / "scontrol").write_text(f"#!/bin/bash\necho '{forgotten}' >&2\nexit 1\n")
    for name in ("sbatch", "scontrol"):
        (cluster / name).chmod(0o755)
    words = [PYTHON, str(ROOT / "benchmark/run"), "--tiny", "--no-build", "--build", str(BUILD), "--out", str(out), "--profile", "slurm", "--shards", "4",
             "--minutes", "0.0001", "device"]
    done = subprocess.run(words, capture_output=True, text=True, env={**os.environ, "PATH": f"{cluster}:{os.environ['PATH']}"})
    status_of_jobs(cluster, forgotten)
    jobs = (cluster / "jobs").read_text().splitlines()
    expect(done.returncode == 0 and "did not fit: 0/4, 1/4, 2/4, 3/4 of 4" in (out / "index.html").read_text(), f"on a cluster: exit {done.returncode}, {done.stderr}")
    expect(len(jobs) == 1 and "--mem=2000" in jobs[0], f"of 4 shards 1 uses up the minutes, but {len(jobs)} jobs were submitted: {jobs}")


def exit_codes(folder):
    """2 for what was given, 5 where the report cannot be written: before the work."""
    kept = folder / "kept.off"
    kept.write_text("kept")
    same = folder / "grab.json"  # of the name of a report
    same.symlink_to(kept)
    cases = folder / "cases"
    cases.mkdir()
    (cases / "batch_7.off").write_text("kept")
    ticks = ["haptic_ticks", "--level", "2", "--ticks", "10"]
    mesh, script = folder / "grab.off", folder / "grab.script"
    mesh.write_text("OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n")
    grab = ["certify_ends", "--replay", str(mesh)]
    for text, code, said in (("# a: b\nclearance 0x1p-40\ndrag 3 0 0 0x1p1\n", 0, "1 drags, 0 end too early"),
                             *((f"drag {vertex} 0 0 2\n", 2, "the vertex is not a whole number below 4")
                               for vertex in ("4", "-1", "0.5", "1e30")),
                             ("drag x 0 0 2\n", 2, "'x' is not a finite number"), ("", 2, "has no drag")):
        script.write_text(text)
        done = subprocess.run([str(BUILD / "benchmark" / grab[0]), *grab[1:], "--script", str(script)],
                              capture_output=True, text=True)
        expect(done.returncode == code and said in done.stdout + done.stderr, f"a script {text!r}: {done}")
    for words, code, said in (([*ticks, "--depth", "-1000"], 2, "the hand's path"),
                              (grab, 2, "--script"),
                              ([*grab, "--script", str(folder / "nowhere.script")], 2, "cannot open the script"),
                              (["brush_dabs", "--mesh", str(folder / "nowhere.off")], 2, "nowhere.off"),
                              (["device_speed_error", "--nothing"], 2, "--nothing"),
                              ([*ticks, "--reach", "2e9"], 2, "reach"),
                              ([*ticks, "--valence", "2"], 2, "valence"),
                              (["hand_drags", "--level", "2", "--drags", "10", "--depth", "inf"], 2, "depth"),
                              (["hand_drags", "--level", "2", "--drags", "10", "--depth", "1e200"], 2, "depth"),
                              (["hand_drags", "--level", "2", "--drags", "10"], 0, "probe: 10 of 10 drags"),
                              (["brush_dabs", "--mesh", str(kept), "--json", str(same)], 2, "one file"),
                              (["hand_drags", "--json", str(folder / "part.off")], 2, "the name of a mesh"),
                              (["robustness", "--dump", str(cases)], 2, "has cases already"),
                              (["hand_drags", "--json", str(folder / "nowhere/x.json")], 5, "cannot write")):
        done = subprocess.run([str(BUILD / "benchmark" / words[0]), *words[1:]], capture_output=True, text=True)
        expect(done.returncode == code and said in done.stdout + done.stderr, f"{words}: exit {done.returncode}, {done.stderr}")
    expect(kept.read_text() == "kept", "a report is written over a mesh")
    with (folder / "table.txt").open("w") as table:
        done = subprocess.run([str(BUILD / "benchmark/axis_speed_error"), "--queries", "1", "--json", table.name],
                              stdout=table, stderr=subprocess.PIPE, text=True)
    expect(done.returncode == 2 and "standard output" in done.stderr, f"a report over its own table: {done}")


def answers(out, folder):
    """Of a program that is right but for one in ten."""
    queries = folder / "queries"
    queries.mkdir()
    full = folder / "full"
    full.mkdir()
    os.symlink("/dev/full", full / "truth.txt.unfinished")
    (full / "queries.txt").write_text("kept")
    for words in (["--write-queries", str(full)], ["--json", "/dev/full"]):
        done = subprocess.run([str(BUILD / "benchmark/sweep_speed_error"), "--queries", "1", *words], capture_output=True, text=True)
        expect(done.returncode == 5 and "cannot write" in done.stderr, f"{words} where the disk is full: exit {done.returncode}, {done.stderr}")
    expect((full / "queries.txt").read_text() == "kept" and not os.path.lexists(full / "truth.txt"), "answers are replaced by half")
    judged = folder / "judged.json"
    subprocess.run([str(BUILD / "benchmark/sweep_speed_error"), "--queries", "1", "--json", str(judged)], check=True, capture_output=True)
    report = json.loads(judged.read_text())
    expect([(p["exit"], p["asked"], p["broken"]) for p in report.get("promises", [])] == [(10, 3 * len(report["populations"]), 0)],
           f"its three exact rows are not promised to be right: {report.get('promises')}")
    subprocess.run([str(BUILD / "benchmark/sweep_speed_error"), "--queries", "10", "--write-queries", str(queries)], check=True, capture_output=True)
    truth = (queries / "truth.txt").read_text().split("\n")[:-1]
    wrong = sum(i % 10 == 0 for i in range(len(truth)))
    said = [("0" if t[0] == "1" else "1") if i % 10 == 0 else (t if t == "0" else f"1 {eval(t[2:])!r}") for i, t in enumerate(truth)]
    (queries / "other.txt").write_text("# name: Nine of ten\n# seconds: 0.5\n" + "\n".join(said) + "\n")
    done = run(out, "axis", "--answers", str(queries / "other.txt"))
    expect(done.returncode == 0 and "Nine of ten" in (out / "index.html").read_text(), f"answers of another program: exit {done.returncode}, {done.stderr}")
    read = subprocess.run([PYTHON, str(ROOT / "benchmark/quality/read_answers.py"), str(queries / "other.txt")], capture_output=True, text=True)
    row = json.loads(read.stdout)[0]
    expect(row["false_positives"] + row["false_negatives"] == wrong and row["largest_error"] < 1e-15, f"judged wrongly, {wrong} are wrong: {row}")
    (queries / "short.txt").write_text("0\n")
    short = subprocess.run([PYTHON, str(ROOT / "benchmark/quality/read_answers.py"), str(queries / "short.txt")], capture_output=True, text=True)
    expect(short.returncode == 1 and "1 answers to" in short.stderr, f"too few answers: {short.stderr}")
    for name, text in (("short", b"0\n"), ("no_time", b"# seconds: nan\n" + "\n".join(said).encode()),
                       ("no_number", b"# seconds: abc\n" + "\n".join(said).encode()), ("no_text", b"\xff\xfe\0")):
        bad = queries / f"{name}.txt"
        bad.write_bytes(text)
        done = run(folder / "none", "axis", "--answers", str(bad))
        expect(done.returncode == 2 and bad.name in done.stderr and "Traceback" not in done.stderr,
               f"answers that cannot be read: exit {done.returncode}, {done.stderr}")
        expect(not (folder / "none").exists(), "wrong answers are found before anything is run")
    for k, line in enumerate(("1", "1 x", "1 1/0", "7 1/2", "\0", "")):
        place = folder / f"truth{k}"
        place.mkdir()
        (place / "truth.txt").write_text(line + "\n")
        (place / "answers.txt").write_text("0\n")
        done = run(folder / "none", "axis", "--answers", str(place / "answers.txt"))
        expect(done.returncode == 2 and "truth.txt" in done.stderr and "Traceback" not in done.stderr,
               f"truth that is {line!r}: exit {done.returncode}, {done.stderr}")
    script = ROOT / "benchmark/quality/read_answers.py"
    place = folder / "few"
    place.mkdir()
    (place / "truth.txt").write_text("0\n0\n1 1/2\n1 1/2\n")
    for text, code in (("\ufeff# name: X\n0\n-\n1\n1 0.5\n", 0), ("0 abc\n-\n1\n1\n", 1), ("0\n- x\n1\n1\n", 1),
                       ("1 abc\n-\n1\n1\n", 1), ("0\n-\n1\n1 abc\n", 1), ("0\n-\n1\n1 0.5 0.5\n", 1)):
        (place / "answers.txt").write_text(text, encoding="utf-8")
        told = subprocess.run([PYTHON, str(script), str(place / "answers.txt")], capture_output=True, text=True)
        is_told = '"name": "X"' in told.stdout if code == 0 else "is not 0, 1, 1 u or -" in told.stderr
        expect(told.returncode == code and is_told, f"answers {text!r}: {told}")
    expect(os.access(script, os.X_OK), "read_answers.py is not to be run by its name")
    told = subprocess.run([PYTHON, str(script), "--help"], capture_output=True, text=True)
    expect(told.returncode == 0 and "# queries: FOLDER" in told.stdout, f"read_answers.py --help: {told}")


def main():
    if shutil.which("snakemake") is None:
        print("skipped: snakemake is missing (apt-get install snakemake)")
        return 77
    if subprocess.run([PYTHON, "-c", "import jinja2, matplotlib"], capture_output=True).returncode != 0:
        print("skipped: python3-jinja2 or python3-matplotlib is missing")
        return 77
    with tempfile.TemporaryDirectory() as place:
        folder = pathlib.Path(place)
        killed_by_itself(folder / "killed", folder)
        kill_and_resume(folder / "resumed")
        damaged(folder / "resumed")
        check_page(folder / "resumed")
        wrong_use(folder)
        options_are_known()
        no_case_is_left_out()
        missing_part()
        own_minutes(folder / "own_minutes")
        little_time(folder / "little_time")
        death(folder / "death", folder)
        changed_meshes(folder / "changed", folder)
        broken_beside_a_death(folder / "breaks", folder)
        own_meshes(folder / "own", folder)
        exit_codes(folder)
        answers(folder / "answers", folder)
        failing_case(folder / "failing", folder)
        few_jobs(folder / "few_jobs", folder)
        pictures(folder / "resumed", folder)
    print(*faults, sep="\n")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
