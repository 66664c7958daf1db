#!/usr/bin/env python3
"""Pictures of all samples with their skeletons, and the page that shows them: docs/gallery.md and docs/images/samples/; and
those of docs/is_my_skeleton_right.md in docs/images/right/.

Made anew by the program, so that they show what it does; nothing is drawn by hand.
"""
import argparse
import json
import os
import pathlib
import re
import shlex
import subprocess
import sys
import tempfile

SOURCE = pathlib.Path(__file__).resolve().parent.parent
PICTURE = ["--views", "1", "--width", "200", "--height", "200", "--line-width", "3.5"]
COLUMNS = 4

# Beside the samples as they are: the same with other counts and ratios.
VARIANTS = [
    ("plate", ["--count", "12"], "plate with 12 holes"),
    ("prism", ["--count", "3", "--ratio", "5"], "prism on a triangle"),
]

# What docs/is_my_skeleton_right.md shows: name, sample, options of the extraction.
CASES = [
    ("proved", ["quadruped"], []),
    ("outside", ["heptoroid"], ["--no-refine"]),
    ("failed", ["torus"], ["--mode", "thesis", "--no-keep-topology", "--bare-edges", "saturation", "--saturation", "100"]),
    ("too_large", ["quadruped"], ["--smallest", "0.08"]),
    ("too_small", ["quadruped", "--jitter", "0.3", "--resolution", "20000"], ["--smallest", "0", "--detail", "20", "--no-coarsen"]),
]
CASE_PICTURE = ["--views", "1", "--width", "320", "--height", "240", "--line-width", "4"]

HEAD = """\
# Gallery

All samples of `mspskel sample`, with their skeletons: branches blue, ends orange, joints green. `scripts/gallery.py` makes the
pictures and this page.
"""


def run(program, folder, *words):
    return subprocess.run([program, *words], cwd=folder, check=True, capture_output=True, text=True, timeout=300).stdout


def samples(program):
    """Name and description, from --help."""
    text = run(program, ".", "sample", "--help")
    rows = re.findall(r"^  (\S+) +(.+)\n", text[text.index("\nSamples:\n") :], re.MULTILINE)
    return [(name, [], description) for name, description in rows if not name.startswith("--")]


def extract(program, folder, sample, options=()):
    """Writes mesh.off and mesh.skel; whether the skeleton passes its checks."""
    run(program, folder, "sample", sample[0], "mesh.off", *sample[1:])
    words = [program, "mesh.off", "mesh.skel", "-q", "--keep-failed", *options]
    return subprocess.run(words, cwd=folder, capture_output=True, timeout=300).returncode == 0


def picture(program, pictures, name, options):
    """Writes the picture; what is to be said below it."""
    with tempfile.TemporaryDirectory() as folder:
        right = extract(program, folder, [name, *options])
        file = pictures / ("_".join([name, *(word.strip("-") for word in options)]) + ".png")
        run(program, folder, "render", "mesh.off", "mesh.skel", str(file), *PICTURE)
        mesh, skeleton = (json.loads(run(program, folder, "info", file, "--json")) for file in ("mesh.off", "mesh.skel"))
    counts = [(skeleton["components"], "piece"), (skeleton["cycles"], "loop"), (skeleton["leaves"], "end")]
    said = ", ".join(f"{n} {noun}{'' if n == 1 else 's'}" for n, noun in counts if n > 0)
    return file, f"{mesh['faces']:,} faces; {said}{'' if right else '; **fails its check**'}"


def page(program, pictures, chosen):
    cells = []
    for name, options, description in chosen:
        file, said = picture(program, pictures, name, options)
        link = os.path.relpath(file, pictures.parent.parent)
        cells.append((f"![{name}]({link})", f"`{shlex.join([name, *options])}`<br>{description}<br>{said}"))
    text = HEAD
    for begin in range(0, len(cells), COLUMNS):
        row = cells[begin : begin + COLUMNS] + [("", "")] * max(0, begin + COLUMNS - len(cells))
        text += "\n| " + " | ".join(image for image, _ in row) + " |\n" + "|---" * COLUMNS + "|\n"
        text += "| " + " | ".join(words for _, words in row) + " |\n"
    return text


def show_cases(program, pictures):
    pictures.mkdir(parents=True, exist_ok=True)
    for name, sample, options in CASES:
        with tempfile.TemporaryDirectory() as folder:
            extract(program, folder, sample, options)
            run(program, folder, "render", "mesh.off", "mesh.skel", str(pictures / f"{name}.png"), *CASE_PICTURE)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", default=str(SOURCE / "build" / "mspskel"), help="[build/mspskel]")
    parser.add_argument("--docs", type=pathlib.Path, default=SOURCE / "docs", help="folder of the page [docs]")
    parser.add_argument("--only", metavar="NAME", nargs="+", help="these samples alone, and no others on the page")
    given = parser.parse_args()
    chosen = [entry for entry in samples(given.program) + VARIANTS if not given.only or entry[0] in given.only]
    pictures = given.docs.resolve() / "images" / "samples"
    pictures.mkdir(parents=True, exist_ok=True)
    try:
        text = page(os.path.abspath(given.program), pictures, chosen)
        if not given.only:
            show_cases(os.path.abspath(given.program), pictures.parent / "right")
    except subprocess.CalledProcessError as error:
        sys.exit(error.stderr.strip())
    (given.docs / "gallery.md").write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main()
