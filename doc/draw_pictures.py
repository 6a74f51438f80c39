#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Draws the pictures of the manual that the programs `sculpt` and `sculpt_window` make: draw_pictures.py [BUILD [FOLDER]], by default build and doc/pictures.

Needs python3-matplotlib. Charts of measurements are drawn by the scripts beside the benchmarks.
"""
import os
import subprocess
import sys
import tempfile

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as pyplot

HERE = os.path.dirname(os.path.abspath(__file__))
BUILD = sys.argv[1] if len(sys.argv) > 1 else f"{HERE}/../build"
FOLDER = sys.argv[2] if len(sys.argv) > 2 else f"{HERE}/pictures"
DATA = f"{HERE}/../examples/data"
BALL = f"{DATA}/ball_and_moon.off"

# On the side of the ball that one sees.
DAB = "0.42 -0.82 0.38"
BRUSHES = {
    "grab": f"brush grab {DAB} 0.7 0.6\n",
    "inflate": f"brush inflate {DAB} 0.7 0.3\n",
    "smooth": f"brush smooth {DAB} 0.9 0.9\n" * 12,
    "flatten": f"brush flatten {DAB} 0.8 0.8\n" * 6,
    "pinch": f"brush pinch {DAB} 0.7 0.4\n" * 2,
}


def sculpt(mesh, script, *options):
    subprocess.run([f"{BUILD}/examples/sculpt", mesh, "--script", "-", *options], input=script, text=True, check=True,
                   stdout=subprocess.DEVNULL)


def text_of(name):
    with open(f"{DATA}/{name}") as file:
        return file.read()


def knot(folder):
    mesh = f"{folder}/knot.off"
    with open(mesh, "w") as file:
        subprocess.run([sys.executable, f"{DATA}/make_knot.py"], stdout=file, check=True)
    sculpt(mesh, text_of("knot.script"), "--compare", f"{FOLDER}/knot.png", "--picture-view", "0", "0.45", "-1")


def demo():
    sculpt(BALL, text_of("demo.script"), "--picture", f"{FOLDER}/demo.png")
    sculpt(BALL, text_of("demo.script"), "--picture", f"{FOLDER}/contact.png", "--picture-at", "edit", "--picture-zoom", "5")


def brushes(folder):
    fine = f"{folder}/fine.off"
    sculpt(BALL, "remesh 0.045\n", "-o", fine)
    figure, axes = pyplot.subplots(1, 1 + len(BRUSHES), figsize=(15, 3))
    for axis, (name, script) in zip(axes, [("before", "")] + list(BRUSHES.items())):
        picture = f"{folder}/{name}.png"
        sculpt(fine, script, "--picture", picture, "--picture-at", f"@{DAB.replace(' ', ',')}", "--picture-zoom", "1.7")
        image = pyplot.imread(picture)
        axis.imshow(image[:, 150:1050])
        axis.set_title(name)
        axis.axis("off")
    figure.tight_layout()
    figure.savefig(f"{FOLDER}/brushes.png", dpi=100)


def window(folder):
    """By brushes, from the ball; needs xvfb-run."""
    subprocess.run(["xvfb-run", "-a", os.path.abspath(f"{BUILD}/examples/sculpt_window"), "--no-log", "--size", "1280", "800", "--script",
                    f"{DATA}/creature.window-script", "--screenshot", os.path.abspath(f"{FOLDER}/window.png")], cwd=folder, check=True,
                   stdout=subprocess.DEVNULL)


def main():
    os.makedirs(FOLDER, exist_ok=True)
    with tempfile.TemporaryDirectory() as folder:
        knot(folder)
        demo()
        brushes(folder)
        window(folder)


main()
