# SPDX-License-Identifier: GPL-3.0-or-later
"""What there is to run: the steps of performance, quality and robustness, each from the steps.py of its folder."""
import hashlib
import importlib.util
import pathlib
from dataclasses import dataclass, field

BENCHMARK = pathlib.Path(__file__).resolve().parent.parent
PARTS = ("performance", "quality", "robustness")
MODES = ("tiny", "quick", "full")


@dataclass(frozen=True)
class Effort:
    """How much of a step a mode runs."""
    options: str = ""  # of the program; {seed}, {meshes} and {dump}, a folder for failing cases, are put in
    minutes: float = 10  # of one shard; what takes longer is ended, and has died
    shards: int = 1
    memory: int = 2000  # MB of one shard


@dataclass(frozen=True)
class Step:
    """One run of one program, in one or more shards."""
    name: str
    program: str  # its target
    folder: str = "benchmark"  # of the build
    tiny: Effort = None  # seconds: that everything works; None: not in this mode
    quick: Effort = None
    full: Effort = None
    with_meshes: str = ""  # options added where there is a folder of meshes
    with_repair: str = ""  # and where those of them that are refused are to be repaired
    environment: dict = field(default_factory=dict)  # {seed_of_shard} and {share} of `count` are put in
    promise: str = ""  # of a program without a report: what its exit code 0 says
    count: dict = field(default_factory=dict)  # how many of these by mode, in all shards
    part: str = ""

    def effort(self, mode):
        return getattr(self, mode)


def all_steps():
    """By name, in the order of the page."""
    steps = {}
    for part in PARTS:
        spec = importlib.util.spec_from_file_location(f"steps_of_{part}", BENCHMARK / part / "steps.py")
        module = importlib.util.module_from_spec(spec)
        spec.loader.exec_module(module)
        for step in module.STEPS:
            steps[step.name] = Step(**{**step.__dict__, "part": part})
    return steps


def chosen_steps(mode, names):
    """Of this mode; all, or those that are named. A name may be that of a part."""
    chosen = [s for s in all_steps().values() if s.effort(mode)]
    return [s for s in chosen if not names or s.name in names or s.part in names]


def dump_folder(name, shard, shards):
    """Where a shard writes its failing cases, in the folder of the results."""
    return f"failures/{name}/{shard}_of_{shards}"


def share_of(step, mode, shards):
    """How many cases each shard of a step that is given a number is to try: no fewer than that number in all."""
    return -(-step.count.get(mode, 0) // shards)


def digest_of(meshes):
    """Of the names and bytes of a folder's meshes; of none: nothing. Programs do not look into folders in it, and list
    what cannot be read."""
    digest = hashlib.sha256()
    is_mesh = lambda path: path.suffix.lower() in (".off", ".ply", ".obj", ".stl") and path.is_file()
    for path in sorted(filter(is_mesh, pathlib.Path(meshes).iterdir())) if meshes else []:
        content = hashlib.sha256()
        try:
            with open(path, "rb") as file:
                for block in iter(lambda: file.read(1 << 20), b""):
                    content.update(block)
        except OSError as error:
            content.update(error.strerror.encode())
        digest.update(f"{path.name}\0{content.hexdigest()}\0".encode())
    return digest.hexdigest() if meshes else ""


def command_of(step, mode, shard, shards, build, meshes, seed, json, repair=False):
    """(words, environment) of one shard."""
    effort = step.effort(mode)
    words = [str(pathlib.Path(build) / step.folder / step.program)]
    options = effort.options + (" " + step.with_meshes if meshes and step.with_meshes else "")
    options += " " + step.with_repair if meshes and repair else ""
    dump = dump_folder(step.name, shard, shards)
    words += [word.format(seed=seed, meshes=meshes, dump=dump) for word in options.split()]  # a path may have blanks
    environment = {name: value.format(seed_of_shard=seed * 1000 + shard, share=share_of(step, mode, shards))
                   for name, value in step.environment.items()}
    if not step.promise:
        words += ["--json", json, "--shard", f"{shard}/{shards}"]
    return words, environment
