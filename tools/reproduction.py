"""What the commands share that measure anew what papers report: runs that are kept as text, pictures small
enough for a repository, and pages of prose and tables."""
import argparse
import importlib.util
import json
import math
import os
import pathlib
import re
import subprocess
import sys
import textwrap

ROOT = pathlib.Path(__file__).resolve().parent.parent
PAGES = ROOT / "docs" / "reproduction"


def command_line(text, trial=None, folder="reproduction"):
    """Arguments of such a command; `trial`: how long --quick takes, where there is one; `folder`: of the build, for what
    was measured."""
    parser = argparse.ArgumentParser(description=text.split("\n\n")[0])
    parser.add_argument("--build", type=pathlib.Path, default=ROOT / "build", help="folder of the build")
    parser.add_argument("--work", type=pathlib.Path, help=f"folder for what was measured; default: BUILD/{folder}")
    if trial:
        parser.add_argument("--quick", action="store_true", help=f"few seeds and small numbers: a trial of {trial}")
        parser.add_argument("--reuse", action="store_true", help="measure only what --work does not hold yet")
    arguments = parser.parse_args()
    arguments.work = arguments.work or arguments.build / folder
    arguments.program = arguments.build / "packstone"
    arguments.work.mkdir(parents=True, exist_ok=True)
    return arguments


def have_plots():
    if importlib.util.find_spec("matplotlib") is not None:
        return True
    print("no matplotlib (tools/install_dependencies reproduce): the page goes without plots")
    return False


# What was measured.

class Measured:
    """Lines of the modes of a benchmark, split into words; kept as text in a folder. `effort`: the arguments of each
    mode; `skip`: words that each line begins with for people; `alias`: what a mode is called by the benchmark, where one
    of its modes is run with several arguments."""

    def __init__(self, arguments, bench, effort, skip=0, alias=None):
        self.bench = arguments.build / "benchmarks" / bench
        self.work = arguments.work
        self.effort = effort
        self.reuse = arguments.reuse
        self.skip = skip
        self.alias = alias or {}
        self.lines = {}

    def run(self, mode):
        log = self.work / f"{mode}.txt"
        if not (self.reuse and log.exists()):
            print(self.command(mode), flush=True)
            done = subprocess.run([self.bench, *self.words(mode)], stdout=subprocess.PIPE, text=True)
            if done.returncode not in (0, 1):
                sys.exit(f"{self.bench.name} {mode} ended with {done.returncode}")
            log.write_text(done.stdout)
        rows = [line.split() for line in log.read_text().splitlines() if line and not line.startswith("#")]
        self.lines[mode] = [row[self.skip:] for row in rows]
        self.lines[f"{mode} head"] = log.read_text().splitlines()[0].lstrip("# ")

    def run_all(self):
        for mode in self.effort:
            self.run(mode)
        return self

    def words(self, mode):
        return [self.alias.get(mode, mode), *self.effort[mode]]

    def command(self, mode):
        return " ".join([self.bench.name, *self.words(mode)])

    def rows(self, mode, *first):
        """The rest of each line that begins with the words `first`."""
        return [row[len(first):] for row in self.lines[mode] if tuple(row[:len(first)]) == first]

    def effort_of(self, mode):
        """"7 seeds each", from the first line of a mode."""
        return seeds_each(self.lines[f"{mode} head"].split()[0])


def seeds_each(count):
    return f"{count} seeds each" if int(count) > 1 else "a single seed each"


def packed(program, recipe, packing, *options):
    """Packs a recipe; its summary, which is kept beside the packing."""
    done = subprocess.run([program, "pack", recipe, "-o", packing, "--json", *options],
                          stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
    packing.with_name(f"{packing.stem}_summary.json").write_text(done.stdout)
    return json.loads(done.stdout)


# Pictures.

def fewer_colors(path, most_bytes, widths=(800, 720, 640, 560, 480)):
    """Makes a picture small enough: 256 dithered colors, and fewer pixels where that is not enough."""
    if path.stat().st_size <= most_bytes or importlib.util.find_spec("PIL") is None:
        return
    from PIL import Image
    whole = Image.open(path).convert("RGB")
    for width in widths:
        part = whole.resize((width, whole.height * width // whole.width), Image.Resampling.LANCZOS)
        part.quantize(palette=part.quantize(256), dither=Image.Dither.FLOYDSTEINBERG).save(path, optimize=True)
        if path.stat().st_size <= most_bytes:
            return


def new_plot(panels=1, size=(8, 4.4), share=True):
    import matplotlib
    matplotlib.use("Agg")
    from matplotlib import pyplot
    matplotlib.rcParams.update({"font.size": 10, "axes.grid": True, "grid.alpha": 0.3})
    figure, axes = pyplot.subplots(1, panels, figsize=size, sharey=share, squeeze=False)
    return figure, axes[0]


class Pictures:
    """PNG files of one page: names that begin alike, in one folder, none above a number of bytes."""

    def __init__(self, folder, prefix="", most_bytes=150_000):
        self.folder, self.prefix, self.most_bytes = folder, prefix, most_bytes
        folder.mkdir(parents=True, exist_ok=True)

    def path(self, name):
        return self.folder / f"{self.prefix}{name}.png"

    def draw(self, program, packing, name, *options):
        self._draw(program, packing, self.path(name), options)
        fewer_colors(self.path(name), self.most_bytes)

    def draw_beside(self, program, packings, name, *options):
        """Packings side by side in one picture. Undithered, which smooth bodies need less than size does."""
        from PIL import Image
        parts = []
        for packing in packings:
            part = packing.with_suffix(".png")
            self._draw(program, packing, part, options)
            parts.append(Image.open(part).convert("RGB"))
        whole = Image.new("RGB", (sum(part.width for part in parts), max(part.height for part in parts)), "white")
        left = 0
        for part in parts:
            whole.paste(part, (left, 0))
            left += part.width
        for colors in (256, 128, 64, 32):
            whole.quantize(colors, dither=Image.Dither.NONE).save(self.path(name), optimize=True)
            if self.path(name).stat().st_size <= self.most_bytes:
                return

    def save(self, figure, name):
        figure.tight_layout()
        figure.savefig(self.path(name), dpi=100, metadata={"Software": None})
        fewer_colors(self.path(name), self.most_bytes)

    def mark(self, name, text, page):
        """The line of a page that shows a picture."""
        return f"![{text}]({os.path.relpath(self.path(name), page.parent)})"

    @staticmethod
    def _draw(program, packing, path, options):
        subprocess.run([program, "draw", packing, "-o", path, *options], check=True, stderr=subprocess.DEVNULL,
                       stdout=subprocess.DEVNULL)


# Pages.

def table(heads, rows):
    lines = ["| " + " | ".join(heads) + " |", "|" + " --- |" * len(heads)]
    return lines + ["| " + " | ".join(str(cell) for cell in row) + " |" for row in rows] + [""]


def number(text, digits=2):
    """`text` to so many digits that count, in plain notation; a dash is left out."""
    if text == "-":
        return ""
    value = float(text)
    if value == 0:
        return "0"
    places = max(0, digits - 1 - math.floor(math.log10(abs(value))))
    rounded = round(value, digits - 1 - math.floor(math.log10(abs(value))))
    return f"{rounded:.{places}f}"


def blank(words):
    return ["" if word == "-" else word for word in words]


def prose(text):
    """A paragraph, wrapped as the other pages are."""
    return [*textwrap.wrap(" ".join(text.split()), 116, break_long_words=False, break_on_hyphens=False), ""]


def bullets(points):
    lines = []
    for point in points:
        first, *others = prose(point)[:-1]
        lines += [f"- {first}", *(f"  {line}" for line in others)]
    return [*lines, ""]


def machine(build):
    cpu = re.search(r"model name\s*:\s*(.*)", pathlib.Path("/proc/cpuinfo").read_text())
    compiler = re.search(r"CMAKE_CXX_COMPILER:\w+=(.*)", (build / "CMakeCache.txt").read_text())
    version = subprocess.run([compiler[1], "--version"], stdout=subprocess.PIPE, text=True).stdout.splitlines()[0]
    program = subprocess.run([build / "packstone", "--version"], stdout=subprocess.PIPE, text=True).stdout
    return f"{cpu[1] if cpu else 'unknown processor'}, {os.cpu_count()} cores; {version}; {program.splitlines()[0]}"


def write_page(path, lines):
    path.write_text("\n".join(lines).rstrip() + "\n")
    print(f"wrote {path.relative_to(ROOT)}")
