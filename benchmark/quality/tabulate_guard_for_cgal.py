#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Tables and medians from the JSON of one or more runs of guard_for_cgal: tabulate_guard_for_cgal.py RUN.json ...

Exit: 0, 2 a file that cannot be read or is no such report.
"""
import argparse
import contextlib
import io
import json
from statistics import median


def comparisons_of(path):
    """\\throw ValueError, LookupError, TypeError, AttributeError, OSError"""
    with open(path) as file:
        report = json.load(file)
    if not isinstance(report, dict) or "comparisons" not in report:
        raise ValueError("there is no 'comparisons'")
    with contextlib.redirect_stdout(io.StringIO()):  # which finds what a row lacks before anything is printed
        tell(report["comparisons"])
    return report["comparisons"]


def kept(row):
    guarded = row["guarded"]
    has_failed = guarded["failed"] and not row["plain"]["failed"]
    return (guarded["pairs"] == 0 and guarded["valid"] and not has_failed and row["undone_to_the_bit"]
            and row["redone_to_the_bit"])


def print_row(*cells):
    print("|", " | ".join(map(str, cells)), "|")


def begin_table(*heads):
    print()
    print_row(*heads)
    print("|" + len(heads) * "---|")


def of_both(row, field, form, factor=1):
    return f"{factor * row['plain'][field]:{form}} / {factor * row['guarded'][field]:{form}}"


def mesh_and_function(row):
    return row["mesh"].replace("_", " "), row["function"]


def median_ratio(ratios, form):
    """Of those that are: what takes no tick of the clock alone has none. \return text, of none nothing"""
    some = [ratio for ratio in ratios if ratio is not None]
    return f"{median(some):{form}}" if some else ""


def medians(rows, field, form):
    return " / ".join(f"{median(row[way][field] for row in rows):{form}}" for way in ("plain", "guarded"))


def tell_summary(rows):
    pairs = [row["plain"]["pairs"] for row in rows]
    print(
        f"{len(rows)} comparisons, {sum(map(kept, rows))} with 0 pairs, valid, undone and redone to the bit; "
        f"alone {sum(n > 0 for n in pairs)} end with pairs, {sum(pairs)} together"
    )
    for row in rows:
        if not kept(row):
            print("NOT KEPT:", row["mesh"], row["function"], row["way"])


def tell_functions(moved):
    begin_table("function", "way", "meshes", "of these with pairs alone", "% of the way, least and median",
                "seconds alone / guarded, median", "time ratio, median")
    for function, way in dict.fromkeys((row["function"], row["way"]) for row in moved):
        of = [row for row in moved if (row["function"], row["way"]) == (function, way)]
        shares = [100 * row["share"] for row in of if row["share"] is not None]
        print_row(function, way, len(of), sum(row["plain"]["pairs"] > 0 for row in of),
                  f"{min(shares):.1f}, {median(shares):.1f}" if shares else "",
                  medians(of, "seconds", ".2g"), median_ratio((row["time_ratio"] for row in of), ".1f"))
    begin_table("mesh", "function", "way", "pairs alone", "% of the way", "least angle", "mean least angle",
                "seconds guarded", "drags")
    for row in moved:
        print_row(*mesh_and_function(row), row["way"], row["plain"]["pairs"],
                  "" if row["share"] is None else f"{100 * row['share']:.1f}",
                  of_both(row, "least_angle", ".2g"), of_both(row, "mean_least_angle", ".1f"),
                  f"{row['guarded']['seconds']:.2f}", f"{row['drags'] or ''}{' (all)' if row['out_of_work'] else ''}")


def tell_remeshing(remeshed):
    begin_table("mesh", "function", "pairs alone", "least angle", "mean least angle", "valence 6, %", "edge/L",
                "Hausdorff/L", "refused", "seconds", "ratio")
    for row in remeshed:
        print_row(*mesh_and_function(row), row["plain"]["pairs"], of_both(row, "least_angle", ".3g"),
                  of_both(row, "mean_least_angle", ".1f"), of_both(row, "valence_six", ".0f", 100),
                  of_both(row, "length", ".2f"), of_both(row, "hausdorff", ".3f"),
                  f"{row['refused']} of {row['asked']}", of_both(row, "seconds", ".3f"), median_ratio([row["time_ratio"]], ".2f"))
    begin_table("over all remeshings", "alone, median", "guarded, median", "guarded less alone, median",
                "guarded no worse in")

    def tell_medians(name, plain, guarded, worse):
        change = [g - p for p, g in zip(plain, guarded)]
        print_row(name, f"{median(plain):.3g}", f"{median(guarded):.3g}", f"{median(change):.3g}",
                  f"{sum(worse * c <= 0 for c in change)} of {len(change)}")

    for field, worse in (("least_angle", -1), ("mean_least_angle", -1), ("valence_six", -1), ("hausdorff", 1)):
        tell_medians(field, *([row[way][field] for row in remeshed] for way in ("plain", "guarded")), worse)
    off = ([abs(row[way]["length"] - 1) for row in remeshed] for way in ("plain", "guarded"))
    tell_medians("edge/L, distance from 1", *off, 1)
    ratios = [row["time_ratio"] for row in remeshed if row["time_ratio"] is not None]
    print_row("seconds", *(f"{median(row[way]['seconds'] for row in remeshed):.3g}" for way in ("plain", "guarded")),
              f"ratio {median_ratio(ratios, '.2f')}", f"at most 2 times in {sum(ratio <= 2 for ratio in ratios)}")


def tell(rows):
    tell_summary(rows)
    tell_functions([row for row in rows if row["way"] != "remesher"])
    remeshed = [row for row in rows if row["way"] == "remesher" and not row["plain"]["failed"]]
    if remeshed:
        tell_remeshing(remeshed)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("reports", nargs="+", metavar="RUN.json", help="what guard_for_cgal --json has written")
    arguments = parser.parse_args()
    rows = []
    for path in arguments.reports:
        try:
            rows += comparisons_of(path)
        except (OSError, ValueError) as error:
            parser.error(f"{path} is not what guard_for_cgal --json has written: {error}")
        except (LookupError, TypeError, AttributeError) as error:
            parser.error(f"{path} is not what guard_for_cgal --json has written: {error!r}")
    tell(rows)


if __name__ == "__main__":
    main()
