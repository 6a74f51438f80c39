#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Tables and medians from the JSON of one or more runs of guard_for_cgal: tabulate_guard_for_cgal.py RUN.json ..."""
import argparse
import json
import statistics

parser = argparse.ArgumentParser(description=__doc__)
parser.add_argument("reports", nargs="+", metavar="RUN.json", help="what guard_for_cgal --json has written")


def comparisons_of(path):
    try:
        with open(path) as file:
            return json.load(file)["comparisons"]
    except OSError as error:
        parser.error(str(error))
    except (LookupError, RecursionError, TypeError, ValueError) as error:
        parser.error(f"{path} is no report of guard_for_cgal: {error!r}")


rows = [row for path in parser.parse_args().reports for row in comparisons_of(path)]
remeshed = [row for row in rows if row["way"] == "remesher" and not row["plain"]["failed"]]
moved = [row for row in rows if row["way"] != "remesher"]
median = statistics.median


def kept(row):
    return (
        row["guarded"]["pairs"] == 0
        and row["guarded"]["valid"]
        and row["undone_to_the_bit"]
        and row["redone_to_the_bit"]
    )


def both(row, field, form):
    return f"{row['plain'][field]:{form}} / {row['guarded'][field]:{form}}"


def mesh_and_function(row):
    return f"| {row['mesh'].replace('_', ' ')} | {row['function']} |"


print(
    f"{len(rows)} comparisons, {sum(kept(row) for row in rows)} with 0 pairs, valid, undone and redone to the bit; "
    f"alone {sum(row['plain']['pairs'] > 0 for row in rows)} end with pairs, {sum(row['plain']['pairs'] for row in rows)} together"
)
for row in rows:
    if not kept(row):
        print("NOT KEPT:", row["mesh"], row["function"], row["way"])

print(
    "\n| function | way | meshes | of these with pairs alone | % of the way, least and median | seconds alone / guarded, median | time ratio, median |"
)
print("|---|---|---|---|---|---|---|")
for function, way in dict.fromkeys((row["function"], row["way"]) for row in moved):
    of = [row for row in moved if (row["function"], row["way"]) == (function, way)]
    shares = [100 * row["share"] for row in of]
    share = "" if way == "functor" else f"{min(shares):.1f}, {median(shares):.1f}"
    print(
        f"| {function} | {way} | {len(of)} | {sum(row['plain']['pairs'] > 0 for row in of)} | {share} "
        f"| {median(row['plain']['seconds'] for row in of):.2g} / {median(row['guarded']['seconds'] for row in of):.2g} "
        f"| {median(row['time_ratio'] for row in of):.1f} |"
    )

print(
    "\n| mesh | function | way | pairs alone | % of the way | least angle | mean least angle | seconds guarded | drags |"
)
print("|---|---|---|---|---|---|---|---|---|")
for row in moved:
    print(
        mesh_and_function(row),
        f"{row['way']} | {row['plain']['pairs']} | {100 * row['share']:.1f} | {both(row, 'least_angle', '.2g')} "
        f"| {both(row, 'mean_least_angle', '.1f')} | {row['guarded']['seconds']:.2f} | {row['drags'] or ''}{' (all)' if row['out_of_work'] else ''} |",
    )

if remeshed:
    print(
        "\n| mesh | function | pairs alone | least angle | mean least angle | valence 6, % | edge/L | Hausdorff/L | refused | seconds | ratio |"
    )
    print("|---|---|---|---|---|---|---|---|---|---|---|")
    for row in remeshed:
        print(
            mesh_and_function(row),
            f"{row['plain']['pairs']} | {both(row, 'least_angle', '.3g')} | {both(row, 'mean_least_angle', '.1f')} "
            f"| {100 * row['plain']['valence_six']:.0f} / {100 * row['guarded']['valence_six']:.0f} | {both(row, 'length', '.2f')} "
            f"| {both(row, 'hausdorff', '.3f')} | {row['refused']} of {row['asked']} | {both(row, 'seconds', '.3f')} | {row['time_ratio']:.2f} |",
        )
    print(
        "\n| over all remeshings | alone, median | guarded, median | guarded less alone, median | guarded no worse in |"
    )
    print("|---|---|---|---|---|")
    for field, worse in (("least_angle", -1), ("mean_least_angle", -1), ("valence_six", -1), ("hausdorff", 1)):
        change = [row["guarded"][field] - row["plain"][field] for row in remeshed]
        print(
            f"| {field} | {median(row['plain'][field] for row in remeshed):.3g} | {median(row['guarded'][field] for row in remeshed):.3g} "
            f"| {median(change):.3g} | {sum(worse * c <= 0 for c in change)} of {len(remeshed)} |"
        )
    off = {way: [abs(row[way]["length"] - 1) for row in remeshed] for way in ("plain", "guarded")}
    print(
        f"| edge/L, distance from 1 | {median(off['plain']):.3g} | {median(off['guarded']):.3g} "
        f"| {median(g - p for p, g in zip(off['plain'], off['guarded'])):.3g} "
        f"| {sum(g <= p for p, g in zip(off['plain'], off['guarded']))} of {len(remeshed)} |"
    )
    print(
        f"| seconds | {median(row['plain']['seconds'] for row in remeshed):.3g} | {median(row['guarded']['seconds'] for row in remeshed):.3g} "
        f"| ratio {median(row['time_ratio'] for row in remeshed):.2f} | at most 2 times in {sum(row['time_ratio'] <= 2 for row in remeshed)} |"
    )
