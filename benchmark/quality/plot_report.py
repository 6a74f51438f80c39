# SPDX-License-Identifier: GPL-3.0-or-later
"""The command line of scripts that draw what a benchmark has written with --json."""
import argparse
import json
import os


def plot_report(documentation, draw):
    """Draws the report that the first argument names to the picture that the second one does.

    draw(report): makes a figure of matplotlib. Exit: 0 drawn, 2 a file that is no such report, or a picture that cannot
    be written or is the report."""
    parser = argparse.ArgumentParser(description=documentation, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("report", help="what the benchmark has written")
    parser.add_argument("picture", help="where the plots go: .png, .svg or .pdf")
    arguments = parser.parse_args()
    if os.path.exists(arguments.picture) and os.path.realpath(arguments.picture) == os.path.realpath(arguments.report):
        parser.error(f"{arguments.picture} is the report: name another file for the picture")
    try:
        with open(arguments.report) as file:
            figure = draw(json.load(file))
    except OSError as error:
        parser.error(str(error))
    except (LookupError, RecursionError, TypeError, ValueError) as error:
        parser.error(f"{arguments.report} is no such report: {error!r}")
    try:
        figure.savefig(arguments.picture)
    except (OSError, ValueError) as error:  # not all of them name a file
        parser.error(f"{arguments.picture}: {error}")
