# The table of docs/results/paper.md: our errors beside those that Cardoso and Kry (2012) print.
#   paper_tables.py JSON ... > MARKDOWN
# JSON: what `paim-analyze BAKE -o DIR --components 20,7,4,2 --bands 4,2 --json` printed, once for each
# reference. Standard library only.
import json
import sys
from pathlib import Path

# Percent, from the paper: kept → theoretical error (E5), visual error (E6).
PRINTED = {
    "geometry_components": {20: (0.58, 2.83), 7: (2.23, 4.41), 4: (4.68, 5.37), 2: (8.3, 6.0)},
    "transfer_components": {20: (7.67, 0.64), 7: (15.56, 1.2), 4: (20.24, 1.75), 2: (25.5, 2.22)},
    "bands": {4: (None, 0.5), 2: (None, 1.6)},
}
NAMES = {
    "geometry_components": "geometry components",
    "transfer_components": "transfer components",
    "bands": "bands",
}


def percent(value):
    if value is None:
        return "–"
    return f"{100 * value:.3g}"


def main(files):
    reports = [json.loads(Path(name).read_text()) for name in files]
    lights = list(reports[0]["bands"][0]["visual_error"])
    heads = ["kept", "theory, paper", "theory", "seen, paper"]
    for report in reports:
        heads += [f"{light}, {report['reference']['kind']}" for light in lights]
    print("| " + " | ".join(heads) + " |")
    print("|---" * len(heads) + "|")
    for curve, printed in PRINTED.items():
        for kept, (theory, seen) in printed.items():
            cells = [f"{kept} {NAMES[curve]}", "–" if theory is None else f"{theory:g}"]
            points = [next(p for p in r[curve] if p["kept"] == kept) for r in reports]
            cells += [percent(points[0]["theory_error"]), f"{seen:g}"]
            for point in points:
                cells += [percent(point["visual_error"][light]) for light in lights]
            print("| " + " | ".join(cells) + " |")


if __name__ == "__main__":
    if len(sys.argv) < 2:
        sys.exit(__doc__ or "paper_tables.py JSON ...")
    main(sys.argv[1:])
