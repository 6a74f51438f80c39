#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Asks device_calculator for every configuration of a reference file and compares within the file's tolerances.

usage: check_calculator.py DEVICE_CALCULATOR DEVICE_WORKSPACE
The reference is device/reference_sample.json of the folder that HAPTIC_SCULPT_SHARED names; exit 77 (skipped in part) where
the variable is not set.
"""
import json
import math
import os
import resource
import subprocess
import sys
import tempfile

program, shared = sys.argv[1], os.environ.get("HAPTIC_SCULPT_SHARED")
failures = []

# What does not need the reference: lines no caller should send must not cost memory, stack or the answers after them.
plain = {"op": "forward", "form": "ditetra", "params": {"R": 0.03, "l1": 0.07, "l2": 0.1}, "theta": [1, 1.1, 0.9]}
good_line = json.dumps(plain)


def expect(condition, *what):
    if not condition:
        failures.append(what)


def answers(lines, address_space=None):
    """The answers to these lines, parsed; none if the program dies."""
    def limit():
        if address_space:
            resource.setrlimit(resource.RLIMIT_AS, (address_space, address_space))
    run = subprocess.run([program], input="\n".join(lines).encode() + b"\n", stdout=subprocess.PIPE, stderr=subprocess.PIPE, timeout=100, preexec_fn=limit)
    expect(run.returncode == 0, "exit code", run.returncode, [line[:40] for line in lines])
    got = [json.loads(line) for line in run.stdout.decode().splitlines()]
    expect(len(got) == len(lines), len(lines), "lines,", len(got), "answers", [line[:40] for line in lines])
    return got if len(got) == len(lines) else [{}] * len(lines)


def expect_errors(lines, error, address_space=None):
    """Each line is refused with this error, and a good one after it is answered."""
    got = answers([both for line in lines for both in (line, good_line)], address_space)
    for line, refused, good in zip(lines, got[::2], got[1::2]):
        expect(refused.get("ok") is False and refused.get("error") == error and len(refused.get("message", "")) in range(1, 1100), error, line[:60], refused)
        expect(good.get("ok") is True, "a good line after", line[:60], good)


def nested(depth):  # the request itself is the first level
    return good_line[:-1] + ', "x": ' + "[" * (depth - 1) + "]" * (depth - 1) + "}"


expect_errors(['{"params":{},"op":"forward","form":' + "[" * 500000 + "]" * 500000 + "}", '{"op":"forward","form":' + "[" * 87000, "[" * 1000000, '{"a":' * 150000, nested(33)], "nested_too_deep")
expect_errors(["[" * 50000000, " " * (2**20 - len(good_line) + 1) + good_line, '"' + "a" * 2**21], "line_too_long", None if "sanitize" in program else 3 * 2**30)
expect_errors(["[" + "[]," * 300000 + "[]]", "[" + "1," * 1000 + "1]", '{"x":[' + "1," * 999 + "1]}"], "too_many_values")
expect_errors(['"' + "a" * 1000000, "\x00\x01\x1b[31m", good_line + "\x00 }{"], "malformed_json")
expect(answers([good_line, '{"op":,}'])[1].get("message", "").startswith("line 2, column 7"), "the line of the input")
for line in (good_line + "\x00", nested(33), "1" * 2**21):
    expect(answers([good_line, line])[1].get("message", "").startswith("line 2: "), "the line of what cannot be read", line[:60])
too_large = answers([good_line, '{"theta":[1e400,1,1]}'])[1]
expect(too_large.get("message", "").startswith("line 2: "), "the line of a number that is too large", too_large)
just, deep, many = answers([" " * (2**20 - len(good_line)) + good_line, nested(32), good_line[:-1] + ', "x": [' + "1," * 900 + "1]}"])
expect(many.get("ok") is True and many.get("unknown_keys") == ["x"], "many values", many)
expect(just.get("ok") is True and "unknown_keys" not in just, "a line of the greatest length", just)
expect(deep.get("ok") is True and deep.get("unknown_keys") == ["x"], "the deepest nesting", deep)

process = subprocess.Popen([program], stdin=subprocess.PIPE, stdout=subprocess.PIPE)


def ask_process(line):
    try:
        process.stdin.write(line.encode() + b"\n")
        process.stdin.flush()
    except BrokenPipeError:
        return {}
    return json.loads(process.stdout.readline() or b"{}")


expect(ask_process(good_line).get("ok") is True, "a good line")
size = next(int(line.split()[1]) * 1024 for line in open(f"/proc/{process.pid}/status") if line.startswith("VmSize"))
if size < 2**34:  # an address sanitizer reserves more and does not survive a limit
    resource.prlimit(process.pid, resource.RLIMIT_AS, (size + 2**19, size + 2**19))
    starved = ask_process('{"x": "' + "a" * 1000000 + '"}')
    expect(starved.get("ok") is False and starved.get("error") == "out_of_memory" and starved.get("message"), "out of memory", starved)
    expect(ask_process(good_line).get("ok") is True, "a good line after running out of memory")
try:
    process.stdin.close()
except BrokenPipeError:
    pass
expect(process.wait() == 0, "exit code after running out of memory")

joints = {"torque_limit": 0.2, "angle_limits": [-0.5, 2.5], "friction": 1e-4, "coulomb": 1e-3, "encoder_step": 1.53e-4}
with_joints, wrong = answers([json.dumps({**plain, "params": {**plain["params"], **joints}}), json.dumps({**plain, "params": {**plain["params"], "coulomb": -1}})])
expect(with_joints.get("ok") is True and "unknown_keys" not in with_joints, "a device's keys", with_joints)
expect(wrong.get("error") == "invalid_parameters" and "coulomb" in wrong["message"], "negative friction", wrong)
answered, same, failed = answers([json.dumps({**plain, "thetas": 1, "Mode": -1, "params": {**plain["params"], "Gravity": 1}}), good_line,
                                  json.dumps({**plain, "theta": None, "wrnch": [1]})])
expect(answered.pop("unknown_keys", None) == ["Mode", "params.Gravity", "thetas"] and answered == same, "unknown keys", answered)
expect(failed.get("error") == "bad_request" and failed.get("unknown_keys") == ["wrnch"], "unknown keys of a failure", failed)

run = subprocess.run([program, "--help"], stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
expect(run.returncode == 0 and not run.stderr and b"usage:" in run.stdout, "--help", run)
examples = [line.strip() for line in run.stdout.decode().splitlines() if line.strip().startswith('{"op"')]
expect(examples and all(answer.get("ok") is True and "unknown_keys" not in answer for answer in answers(examples)), "the examples of --help", examples)
run = subprocess.run([program, "--hlep"], stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
expect(run.returncode == 2 and not run.stdout and b"--hlep" in run.stderr, "a wrong argument", run)
with open("/dev/full", "wb") as full:
    for arguments in [], ["--help"]:
        run = subprocess.run([program, *arguments], input=good_line.encode(), stdout=full, stderr=subprocess.PIPE)
        expect(run.returncode == 5 and b"standard output" in run.stderr, "answers that cannot be written", run)
folder = os.open("/", os.O_RDONLY)
expect(subprocess.run([program], stdin=folder, stderr=subprocess.PIPE).returncode == 2, "requests that cannot be read")
os.close(folder)


def workspace(*arguments, stdout=subprocess.DEVNULL):
    return subprocess.run([sys.argv[2], *arguments], stdout=stdout, stderr=subprocess.PIPE, text=True, timeout=100)


with tempfile.TemporaryDirectory() as folder:
    samples, device = f"{folder}/samples.txt", f"{folder}/device.json"
    good = '{"form":"ditetra","R":0.03,"l1":0.07,"l2":0.1,"r":0,"m1":0.05,"m2":0.05,"M":0.1}'
    for text, code, part in ((good, 0, ""), ('{"params":' * 50000, 3, "32 deep"),
                             (good[:-1] + ',"torque_limit":1e308}', 3, "range of numbers"),
                             ('"' + "a" * 900000, 3, "cannot be read"), (" " * 1100000, 3, "1 MiB")):
        with open(device, "w") as file:
            file.write(text)
        run = workspace(samples, device)
        expect(run.returncode == code and part in run.stderr and len(run.stderr) < 1000,
               f"the workspace of {text[:20]}", run.stderr[:200])
        expect(len(open(samples).read().splitlines()) > 100, "samples are written, and stay where a device is refused")
    expect(workspace(samples, f"{folder}/none.json").returncode == 3, "a device that is not there")
    expect(workspace("/dev/full", device).returncode == 5, "samples that cannot be written")
    expect(workspace(samples, samples).returncode == 2, "one file twice")
    with open(device, "w") as file:
        file.write(good)
    os.symlink(device, f"{folder}/link.txt")
    for arguments in ([f"{folder}/link.txt", device], [device], [samples, device, "more"], ["--bogus"], [""]):
        kept = workspace(*arguments).returncode == 2 and open(device).read() == good
        expect(kept, f"samples in the place of the device: {arguments}")
    with open(f"{folder}/damaged.json", "w") as file:
        file.write("]" + good)
    expect(workspace(f"{folder}/damaged.json").returncode == 2, "samples in the place of a damaged device")
    for text, code in (('{"params":' + good + "}", 0), (good[:-1] + ',"fiction":1}', 3)):
        with open(device, "w") as file:
            file.write(text)
        expect(workspace(samples, device).returncode == code, f"the device {text[:12]}")
    with open("/dev/full", "w") as full:
        expect(workspace("--help", stdout=full).returncode == 5, "words that cannot be written")

if not shared:
    print("skipped: the reference is read only where HAPTIC_SCULPT_SHARED names its folder")
    for failure in failures:
        print("FAILED", failure)
    sys.exit(1 if failures else 77)
reference = json.load(open(os.path.join(shared, "device/reference_sample.json")))
requests, checks = [], []


def flat(value):
    return [value] if not isinstance(value, list) else [x for part in value for x in flat(part)]


def relative(got, want):
    got, want = flat(got), flat(want)
    assert len(got) == len(want), (len(got), len(want))
    scale = math.sqrt(sum(w * w for w in want)) or 1.0
    return math.sqrt(sum((g - w) ** 2 for g, w in zip(got, want))) / scale


worst = {}


def note(name, ratio, tag):
    if ratio > worst.get(name, (-1,))[0]:
        worst[name] = (ratio, tag)
    if not ratio <= 1:
        failures.append((name, ratio, tag))


def ask(request, check):
    requests.append(json.dumps(request))
    checks.append(check)


def forward(group, entry, seed_key="phi_seed", position_tolerance=None, op="dynamics"):
    params = entry["params"]
    request = {"form": params["form"], "params": params, "op": op, "theta": entry["theta"]}
    if op == "dynamics":
        request.update(thetad=entry["thetad"], thetadd=entry["thetadd"], wrench=entry["wrench"])
    if params["form"] == "ditetra":
        request["mode"] = entry["mode"]
    elif seed_key:
        request["phi_seed"] = entry[seed_key]
    tag = (group, entry.get("tag"), seed_key)
    keys = {"ok", "p", "Q", "joints", "J", "condA"} | ({"v", "a", "spatial", "paper", "tau_wrench"} if op == "dynamics" else set())

    def check(answer):
        if not answer.get("ok"):
            failures.append((group, answer, tag))
            return
        assert set(answer) == keys, (set(answer) ^ keys, tag)
        condition = entry.get("condA", answer["condA"])
        l2 = params["l2"]
        note(group + " p", math.dist(answer["p"], entry["p"]) / l2 / (position_tolerance or 1e-14 * condition), tag)
        note(group + " condA", abs(answer["condA"] / condition - 1) / (1e-14 * condition), tag)
        for key, tolerance in (("Q", 1e-14), ("J", 2e-14), ("tau_wrench", 5e-14), ("v", 5e-14), ("a", 5e-14)):
            if key in entry and key in answer:
                note(f"{group} {key}", relative(answer[key], entry[key]) / (tolerance * condition), tag)
        if op == "dynamics":
            for model in ("spatial", "paper"):
                for key, tolerance in (("M", 2e-14), ("C", 5e-14), ("gravity", 5e-14), ("tau", 5e-14)):
                    note(f"{group} {model} {key}", relative(answer[model][key], entry[model][key]) / (tolerance * condition), tag)

    ask(request, check)


def expect_failure(request, tag):
    def check(answer):
        if answer.get("ok") is not False or set(answer) != {"ok", "error", "message"}:
            failures.append(("expected a failure", answer, tag))
    ask(request, check)


def modes(group, entry):
    def check(answer):
        if answer.get("n_modes") != entry["n_modes"]:
            failures.append((group + " n_modes", answer, entry["tag"]))
        elif "all_phi" in entry:
            note(group + " all_phi", max(map(lambda a, b: abs(a - b), flat(answer["all_phi"]), flat(entry["all_phi"]))) / 1e-12, entry["tag"])
    ask({"form": entry["params"]["form"], "params": entry["params"], "op": "modes", "theta": entry["theta"]}, check)


def inverse(group, entry, point):
    def check(answer):
        if not answer.get("ok"):
            failures.append((group, answer, entry.get("tag")))
            return
        for pair, want in zip(answer["ik_theta_minus_plus"], entry["ik_theta_minus_plus"]):
            opening = (want[1] - want[0]) / 2
            closeness = 1 - abs(math.cos(opening))
            for g, w in zip(pair, want):
                note(group + " angles", abs(g - w) / (2e-14 / math.sqrt(max(closeness, 1e-16))), entry.get("tag"))
    ask({"form": "ditetra", "params": entry["params"], "op": "inverse", "p": point}, check)


for entry in reference["ditetra"]:
    forward("ditetra", entry)
    inverse("ditetra inverse", entry, entry["p"])
for entry in reference["general"]:
    forward("general", entry)
    forward("general, home", entry, seed_key=None)
    modes("general", entry)
    def seeded(answer, entry=entry):
        if not answer.get("ok"):
            failures.append(("general inverse", answer, entry["tag"]))
        else:
            note("general inverse", max(abs(a - b) for a, b in zip(answer["theta"], entry["theta"])) / (1e-14 * entry["condA"] * entry["condJp"] * 10), entry["tag"])
    ask({"form": "general", "params": entry["params"], "op": "inverse", "p": entry["p"], "theta": [t + 0.005 * s for t, s in zip(entry["theta"], (1, -1, 1))]}, seeded)
hard = reference["hard"]
for entry in hard["ditetra_fk"]:
    forward("near the elbow plane", entry, position_tolerance=4 * 2.2e-16 / entry["h_over_l2"], op="forward")
for group in ("ditetra_singular_ik", "general_phi_degenerate"):
    for entry in hard[group]:
        forward(group, entry)
for entry in hard["general_near_singular"]:
    for seed_key in ("phi_seed", "phi_exact_seed", None):
        forward("general_near_singular", entry, seed_key=seed_key)
for entry in hard["mirror_near_collinear"]:
    forward("mirror_near_collinear", entry, seed_key=None, op="forward")
for group in ("ditetra_fk_fail", "general_fk_fail", "elbows_collinear"):
    for entry in hard[group]:
        request = {"form": entry["params"]["form"], "params": entry["params"], "op": "forward", "theta": entry["theta"]}
        if entry["expect"].startswith("fail"):
            expect_failure(request, (group, entry.get("tag")))
        else:
            ask(request, lambda answer, entry=entry: answer.get("ok") or failures.append((group, answer, entry["tag"])))
            modes(group, entry)
for group in ("ditetra_ik_fail", "general_ik_fail"):
    for entry in hard[group]:
        expect_failure({"form": entry["params"]["form"], "params": entry["params"], "op": "inverse", "p": entry["p"],
                        **({"theta": [1, 1, 1]} if "general" in group else {})}, (group, entry.get("tag")))
for entry in hard["ditetra_ik_boundary"]:
    inverse("ditetra_ik_boundary", entry, entry["p"])
for entry in hard["general_ik_pos"]:
    def home(answer, entry=entry):
        if not answer.get("ok"):
            failures.append(("general_ik_pos", answer, entry["tag"]))
        else:
            note("general_ik_pos", max(abs(a - b) for a, b in zip(answer["theta"], entry["home_theta"])) / 1e-12, entry["tag"])
    ask({"form": "general", "params": entry["params"], "op": "inverse", "p": entry["p"], "theta": [round(t, 1) for t in entry["home_theta"]]}, home)
    ask({"form": "general", "params": entry["params"], "op": "inverse", "p": entry["p"]}, home)

# What no caller should send, each answered and gone past.
good = reference["ditetra"][0]
base = {"form": "ditetra", "params": good["params"], "op": "forward", "theta": good["theta"]}
of_general = {**base, "form": "general", "params": reference["general"][0]["params"]}
ask(of_general, lambda answer: answer["ok"] or failures.append(("the general form without a mode", answer, "")))
for line in ("", "{", "[]", "null", "7", '{"op":', '{"form":"ditetra"}', "\xff\xfe", "[" * 5000, '{"theta":NaN}', '{"theta":[1e999,0,0]}',
             json.dumps({**base, "theta": [1, 2]}), json.dumps({**base, "theta": ["a", 1, 2]}), json.dumps({**base, "theta": [float("nan"), 0, 0]}),
             json.dumps({**base, "theta": [float("inf"), 0, 0]}), json.dumps({**base, "op": "fly"}), json.dumps({**base, "form": "hexapod"}),
             json.dumps({**base, "params": {**base["params"], "form": "general"}}), json.dumps({**base, "mode": 0}), json.dumps({**of_general, "mode": 1}),
             json.dumps({**base, "params": None}), json.dumps({**base, "op": "dynamics"})):
    requests.append(line)
    checks.append(lambda answer, line=line: answer.get("ok") is False and set(answer) == {"ok", "error", "message"} or failures.append(("hostile", answer, line[:60])))
ask({"form": "ditetra", "op": "modes", "params": {**good["params"], "R": 0.5}, "theta": [1, 1, 1]},  # too far apart
    lambda answer: answer.get("n_modes") == 0 and answer.get("ok") is True or failures.append(("no mode", answer, "R")))
for form in ("ditetra", "general"):
    for op in ("forward", "dynamics", "modes", "inverse"):
        for key in ("R", "l1", "l2", "r", "m1", "M"):
            for value in (0, -1, 1e300, -1e300, 5e-324, 1e-300, True, "x", None):
                if value == 0 and key in ("m1", "M"):
                    continue
                request = {"form": form, "op": op, "params": {**good["params"], key: value}, "theta": [1, 1, 1], "thetad": [0, 0, 0], "thetadd": [0, 0, 0], "p": [0, 0, .1]}
                if value in (5e-324, 1e-300) and (key in ("m1", "M") or form == "ditetra" and key == "r"):
                    continue
                expect_failure(request, (form, op, key, value))
for theta in ([1e300, 1, 1], [5e-324, 0, 0], [1e17, -1e17, 3]):  # any verdict will do, but no number may be missing
    ask({**base, "theta": theta}, lambda answer: "ok" in answer or failures.append(("angles", answer, theta)))
ask({**base, "op": "dynamics", "thetad": [1e300, 1, 1], "thetadd": [0, 0, 0]}, lambda answer: answer["ok"] is False or failures.append(("overflow", answer, "")))
ask({**base, "op": "inverse", "p": [1e300, 0, 0]}, lambda answer: answer["ok"] is False or failures.append(("overflow", answer, "")))
ask(base, lambda answer: answer["ok"] or failures.append(("after all that", answer, "")))

text = "\n".join(requests).encode("latin-1") + b"\n"
run = subprocess.run([program], input=text, stdout=subprocess.PIPE, timeout=300)
lines = run.stdout.decode().splitlines()
assert run.returncode == 0, run.returncode
assert len(lines) == len(requests), (len(lines), len(requests))
for line, check in zip(lines, checks):
    check(json.loads(line, parse_constant=lambda word: failures.append(("not a number", word, line[:80]))))
for name in sorted(worst):
    print(f"{name:40s} {worst[name][0]:9.3g} of the tolerance  at {worst[name][1]}")
for failure in failures[:40]:
    print("FAILED", failure)
print(len(requests), "requests,", len(failures), "failures")
sys.exit(1 if failures else 0)
