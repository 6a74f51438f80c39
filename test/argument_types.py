# SPDX-License-Identifier: GPL-3.0-or-later
"""Types of arguments for argparse, which makes a message and exit code 2, wrong use, of what they refuse."""
import argparse
import math
import os
import pathlib
import re


def pattern(text):
    """A regular expression. Of re.error itself argparse would make a traceback."""
    try:
        return re.compile(text)
    except (re.error, OverflowError, RecursionError) as error:
        raise argparse.ArgumentTypeError(f"'{text}' is no regular expression: {error}") from None


def whole_number(least, most=2**64 - 1):
    def checked(text):
        try:
            value = int(text)
        except ValueError:
            value = least - 1
        if not least <= value <= most:
            raise argparse.ArgumentTypeError(f"'{text}' is not a whole number from {least} to {most}")
        return value

    return checked


def number(least, most=math.inf, why=""):
    """Of what float() reads, nan is out of all bounds, though each comparison of a script lets it pass."""

    def checked(text):
        try:
            value = float(text)
        except ValueError:
            value = math.nan
        if not least <= value <= most:
            raise argparse.ArgumentTypeError(f"'{text}' is not a number from {least:g} to {most:g}{why}")
        return value

    return checked


def file_to_write(text):
    """A path that can be written, looked at before the work of hours whose result goes there."""
    path = pathlib.Path(text)
    try:
        is_new = not os.path.lexists(path)
        open(path, "a").close()
        if is_new:
            path.unlink()
    except OSError as error:
        raise argparse.ArgumentTypeError(f"'{text}' cannot be written: {error.strerror}") from None
    return path
