#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Submits a job of snakemake to Slurm and prints its number: slurm_submit.py JOBSCRIPT

A shard whose minutes are used up is listed here and now as what did not fit: Slurm takes as long for a job that does
nothing as for one that works, and of a night there are thousands.
"""
import json
import os
import pathlib
import shlex
import subprocess
import sys

script = sys.argv[1]
# snakemake writes what it knows of a job into its script.
about = json.loads(next(line.split("=", 1)[1] for line in open(script) if line.startswith("# properties")))
job, resources = about["wildcards"], about["resources"]
if about["rule"] == "shard" and "BENCHMARK_RUN_STEP" in os.environ:  # which the Snakefile sets
    words = [*shlex.split(os.environ["BENCHMARK_RUN_STEP"]), job["step"], job["i"], job["n"],
             "--json", about["output"][0], "--unless-it-fits"]
    if subprocess.run(words, stdout=sys.stderr, check=False).returncode == 0:
        print(f"did_not_fit.{os.getpid()}")
        sys.exit(0)
pathlib.Path("slurm").mkdir(exist_ok=True)
words = ["sbatch", "--parsable", f"--job-name=benchmark.{'.'.join(job.values())}",
         f"--cpus-per-task={about['threads']}", f"--mem={resources['mem_mb']}",
         f"--time={resources['runtime']}", "--output=slurm/%j.log", script]
sys.exit(subprocess.run(words, check=False).returncode)
