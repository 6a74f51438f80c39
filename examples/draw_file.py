# SPDX-License-Identifier: GPL-3.0-or-later
"""The command line of scripts that draw a file that a program has written."""
import argparse
import os
import sys


def pyplot():
    """Of matplotlib, for pictures in files. Where it is missing the program says what to do, and ends with exit code 2.
    """
    try:
        import matplotlib

        matplotlib.use("Agg")
        import matplotlib.pyplot
    except ImportError as error:
        print(f"{error}, for {sys.executable}: apt-get install python3-matplotlib, and take /usr/bin/python3",
              file=sys.stderr)
        sys.exit(2)
    return matplotlib.pyplot


def draw_file(documentation, written_by, load, draw):
    """Draws the file that the first argument names to the picture that the second one does.

    load(path): what is in it. draw(content): a figure of matplotlib. Both throw ValueError where it is something else.
    Exit: 0 drawn, 2 a file that cannot be read or drawn, or a picture that cannot be written or is that file."""
    parser = argparse.ArgumentParser(description=documentation, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("file", help=f"what {written_by} has written")
    parser.add_argument("picture", help="where the plots go: .png, .svg or .pdf")
    arguments = parser.parse_args()
    both = (arguments.file, arguments.picture)
    if all(os.path.exists(path) for path in both) and os.path.samefile(*both):
        parser.error(f"{arguments.picture} is what is drawn: name another file for the picture")
    try:
        figure = draw(load(arguments.file))
    except OSError as error:
        parser.error(str(error))
    except ValueError as error:
        parser.error(f"{arguments.file} is not what {written_by} has written: {error}")
    except (LookupError, TypeError) as error:  # what is drawn has its name, but is something else
        parser.error(f"{arguments.file} is not what {written_by} has written: {error!r}")
    try:
        folder, name = os.path.split(arguments.picture)
        whole = os.path.join(folder, f".new.{os.getpid()}.{name}")
        try:
            figure.savefig(whole, format=os.path.splitext(name)[1][1:] or "png")
            os.replace(whole, arguments.picture)
        finally:
            if os.path.exists(whole):
                os.unlink(whole)
    except (OSError, ValueError) as error:  # not all of them name a file
        parser.error(f"{arguments.picture}: {error}")
