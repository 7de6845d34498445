#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Reckon authors
# SPDX-License-Identifier: Apache-2.0
"""Draws the pictures of docs/dead_reckoning.md from runs of the program:

    python3 docs/figures/make_dead_reckoning.py build/release/reckon [FOLDER]

Runs `reckon bench accuracy` on motions made by formulas and writes dead_reckoning_orders.svg, _curves.svg,
_frontier.svg and _circle.svg beside this file, or into FOLDER. The same program gives the same files. Standard library only.
"""
import csv
import math
import pathlib
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
WIDTH = 760

# Of a model, in every picture the same. Light and dark page: chosen to be read on both.
COLOURS = {"static": ("#6e7781", "#8b949e"), "fpw": ("#0072b2", "#56b4e9"), "rvw": ("#c04f00", "#f0883e"),
           "rpb": ("#00795a", "#2fc79a"), "rvb": ("#a3487f", "#e08fc0"), "auto": ("#24292f", "#f0f3f6"),
           "adaptive": ("#0072b2", "#56b4e9")}


def style():
    light = "".join(f".{name}{{color:{pair[0]}}}" for name, pair in COLOURS.items())
    dark = "".join(f".{name}{{color:{pair[1]}}}" for name, pair in COLOURS.items())
    return ("<style>text{font:12px system-ui,'DejaVu Sans',sans-serif;fill:#24292f}"
            ".title{font-size:15px;font-weight:600}.head{font-size:13px;font-weight:600}.soft{fill:#57606a}"
            ".tick{font-size:11px;fill:#57606a}.page{fill:#ffffff}.grid{stroke:#e6eaee}.axis{stroke:#57606a}"
            ".true{color:#c3c9d0}.ring{fill:#ffffff}.line{fill:none;stroke:currentColor}"
            "text.of{fill:currentColor;font-weight:600}.lost{stroke:#cf222e}"
            + light +
            "@media(prefers-color-scheme:dark){text{fill:#d0d7de}.soft,.tick{fill:#9aa4af}.page,.ring{fill:#0d1117}"
            ".grid{stroke:#262c33}.axis{stroke:#8b949e}.true{color:#4d5661}.lost{stroke:#ff7b72}"
            + dark + "}</style>")


class Picture:
    """Lines of an SVG file."""

    def __init__(self, height, title, *lines):
        self.out = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {height}" width="{WIDTH}" '
                    f'height="{height}" role="img"><title>{escaped(title)}</title>', style(),
                    f'<rect class="page" width="{WIDTH}" height="{height}"/>']
        self.text(20, 27, title, "title")
        for i, line in enumerate(lines):
            self.text(20, 48 + 17 * i, line)

    def text(self, x, y, words, kind="", anchor="start", extra=""):
        self.out.append(f'<text x="{x:.1f}" y="{y:.1f}" class="{kind}" text-anchor="{anchor}" {extra}>'
                        f'{escaped(words)}</text>'.replace(' class=""', "").replace(" >", ">"))

    def line(self, x1, y1, x2, y2, kind, extra=""):
        self.out.append(f'<line class="{kind}" x1="{x1:.1f}" y1="{y1:.1f}" x2="{x2:.1f}" y2="{y2:.1f}" {extra}/>')

    def path(self, points, kind, width=1.6, extra=""):
        data = "M" + " ".join(f"{x:.1f},{y:.1f}" for x, y in points)
        self.out.append(f'<path class="line {kind}" stroke-width="{width}" stroke-linejoin="round" d="{data}" {extra}/>')

    def dot(self, x, y, kind, radius=3.0, hollow=False):
        inside = 'class="ring"' if hollow else 'fill="currentColor"'
        self.out.append(f'<g class="{kind}"><circle cx="{x:.1f}" cy="{y:.1f}" r="{radius}" {inside} '
                        'stroke="currentColor" stroke-width="1.5"/></g>')

    def write(self, path):
        path.write_text("\n".join(self.out + ["</svg>"]) + "\n")


def escaped(words):
    return words.replace("&", "&amp;").replace("<", "&lt;").replace(">", "&gt;")


class Plot:
    """A box of the page with a scale on both axes, each linear or logarithmic."""

    def __init__(self, picture, box, x, y, log_x=False, log_y=False):
        self.picture, self.box = picture, box
        self.x, self.y, self.log_x, self.log_y = x, y, log_x, log_y

    @staticmethod
    def share(value, ends, log):
        if log:
            value, ends = math.log10(value), [math.log10(end) for end in ends]
        return (value - ends[0]) / (ends[1] - ends[0])

    def at(self, x, y):
        left, top, width, height = self.box
        down = min(max(self.share(y, self.y, self.log_y), 0.0), 1.0)
        return left + width * self.share(x, self.x, self.log_x), top + height * (1 - down)

    def grid(self, xs, ys, x_text=str, y_text=str, labels=True):
        left, top, width, height = self.box
        for y in ys:
            _, at = self.at(self.x[0], y)
            self.picture.line(left, at, left + width, at, "grid")
            if labels:
                self.picture.text(left - 7, at + 4, y_text(y), "tick", "end")
        for x in xs:
            at, _ = self.at(x, self.y[0])
            self.picture.line(at, top, at, top + height, "grid")
            self.picture.text(at, top + height + 16, x_text(x), "tick", "middle")
        self.picture.line(left, top + height, left + width, top + height, "axis")

    def path(self, points, kind, width=1.6, extra=""):
        self.picture.path([self.at(*point) for point in points], kind, width, extra)


class Program:
    def __init__(self, path):
        self.path = path

    def rows(self, flag, words):
        with tempfile.TemporaryDirectory() as folder:
            table = pathlib.Path(folder) / "table.csv"
            subprocess.run([self.path, "bench", "accuracy", flag, table, *words.split()], check=True,
                           stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
            with open(table, newline="") as file:
                return [{key: number(value) for key, value in row.items()} for row in csv.DictReader(file)]

    def trace(self, words):
        return self.rows("--trace", words)


def number(cell):
    try:
        return float(cell)
    except ValueError:
        return cell


# --- what each order of prediction makes of a bend ---

ORDERS = (("static", "static: stays"), ("fpw", "fpw: along the tangent"), ("rvw", "rvw: along a parabola"),
          ("rpb", "rpb: along an arc"))


def draw_orders(program, target):
    picture = Picture(452, "One update a second: what a viewer shows of a weaving vehicle",
                      "20 m/s, 5 m to either side, seen from above; no smoothing, no delay.")
    first, last = 4.0, 7.4
    for i, (model, meaning) in enumerate(ORDERS):
        rows = program.trace(f"--motion weave --for 10s --models {model} --curves snap --period 1s")
        worst = max(row["error_m"] for row in rows)
        rows = [row for row in rows if first <= row["t_s"] <= last + 1e-6]
        across, down = i % 2, i // 2
        left, top, width = 56 + 366 * across, 92 + 172 * down, 320
        x0 = 20 * first
        metre = width / (20 * (last - first))
        height = 28 * metre
        plot = Plot(picture, (left, top, width, height), (x0, 20 * last), (-14, 14))
        plot.grid([], (-10, 0, 10), y_text=lambda y: f"{y:g} m")
        picture.text(left, top - 8, meaning, f"head of {model}")
        picture.text(left + width, top - 8, f"off by up to {worst:.1f} m", "soft", "end")
        plot.path([(row["true_x_m"], row["true_y_m"]) for row in rows], "true", 6, 'stroke-linecap="round"')

        # A piece for each update: what was shown jumps between them.
        pieces = {}
        for row in (row for row in rows if row["t_s"] > first + 1e-4):
            pieces.setdefault(row["arrived"], []).append(row)
        pieces = [pieces[key] for key in sorted(pieces)]
        shown = [[(row["shown_x_m"], row["shown_y_m"]) for row in piece] for piece in pieces]
        for before, after in zip(shown, shown[1:]):
            plot.path([before[-1], after[0]], model, 1, 'stroke-dasharray="2 3"')
        for piece in shown:
            plot.path(piece, model, 2)
        for row in rows:
            if abs(row["t_s"] - round(row["t_s"])) < 1e-4:
                picture.dot(*plot.at(row["true_x_m"], row["true_y_m"]), model, 4, hollow=True)
    y = 430
    for x, kind, width, words, extra in ((56, "true", 6, "true path", 'stroke-linecap="round"'), (190, "fpw", 2, "shown", ""),
                                         (300, "fpw", 1, "jump when an update comes", 'stroke-dasharray="2 3"')):
        picture.path([(x, y), (x + 34, y)], kind, width, extra)
        picture.text(x + 44, y + 4, words)
    picture.dot(580, y, "fpw", 4, hollow=True)
    picture.text(592, y + 4, "an update is sent")
    picture.write(target)


# --- how each curve takes an error away ---

CURVES = (("snap", "position jumps"), ("linear", "velocity jumps"), ("quadratic", "… only at the end"),
          ("projective", "… less at the start"), ("cubic", "velocity smooth"), ("quintic", "acceleration too"))


def draw_curves(program, target):
    picture = Picture(446, "How a correction looks: the same updates, six convergence curves",
                      "fpw on the weave, an update each 0.5 s, the error taken away over 0.3 s. Only the motion to the",
                      "side is drawn. An update comes in at the dashed line.")
    first, update, last, most = 6.84, 7.0, 7.45, -26
    for i, (curve, meaning) in enumerate(CURVES):
        times = "" if curve == "snap" else "--converge 300ms --converge-longest 300ms"
        rows = program.trace(f"--motion weave --for 10s --models fpw --curves {curve} --period 500ms {times}")
        pairs = [(a, b) for a, b in zip(rows, rows[1:]) if first <= b["t_s"] <= last]
        left, width = 58 + 116 * i, 104
        upper = Plot(picture, (left, 130, width, 116), (first, last), (-0.6, 2.8))
        lower = Plot(picture, (left, 268, width, 122), (first, last), (most, 14))
        upper.grid([], (0, 1, 2), labels=i == 0)
        lower.grid([], (-20, -10, 0, 10), labels=i == 0)
        picture.text(left, 100, curve, "head")
        picture.text(left, 118, meaning, "soft", extra='style="font-size:11px"')
        for plot in (upper, lower):
            x, bottom = plot.at(update, plot.y[0])
            picture.line(x, plot.box[1], x, bottom, "axis", 'stroke-dasharray="3 3"')
        for after, words in ((0, "0"), (0.3, "0.3 s")):
            picture.text(lower.at(update + after, 0)[0], 406, words, "tick", "middle")
        colour = "rvw" if curve == "cubic" else "fpw"
        upper.path([(first, 0), (last, 0)], "true", 5)
        lower.path([(b["t_s"], rate_of(a, b, "true")) for a, b in pairs], "true", 5)
        upper.path([(b["t_s"], b["shown_y_m"] - b["true_y_m"]) for _, b in pairs], colour, 2)
        drawn = [(b["t_s"], rate_of(a, b, "shown")) for a, b in pairs]
        lower.path(drawn, colour, 2)
        time, least = min(drawn, key=lambda point: point[1])
        if least < most:
            x, y = lower.at(time, most)
            picture.text(x + 7, y - 5, f"{least:.0f} m/s", f"of {colour}")
    picture.text(18, 188, "shown − true [m]", "soft", "middle", 'transform="rotate(-90 18 188)"')
    picture.text(18, 329, "velocity [m/s]", "soft", "middle", 'transform="rotate(-90 18 329)"')
    for x, kind, wide, words in ((58, "true", 5, "true"), (150, "fpw", 2, "drawn at 60 Hz"),
                                 (310, "rvw", 2, "drawn, the default curve")):
        picture.path([(x, 430), (x + 34, 430)], kind, wide)
        picture.text(x + 42, 434, words)
    picture.write(target)


def rate_of(before, after, what):
    """Sideways velocity over the frame between two rows."""
    key = f"{what}_y_m"
    return (after[key] - before[key]) / (after["t_s"] - before["t_s"])


# --- error against updates ---

# Name, heading, thresholds [m], and the error at which updates are compared [m].
FRONTIERS = (("weave", "weave: 20 m/s, 5 m to either side", (0.05, 0.1, 0.2, 0.5, 1, 2, 5), 0.5),
             ("hand", "hand: reaches of 10 cm, with pauses", (0.0002, 0.0005, 0.001, 0.0025, 0.005, 0.01, 0.02), 0.005))
MODELS = ("static", "fpw", "rpb", "rvb", "rvw", "auto")


def front_of(rows):
    """Rows than which none has both fewer updates and an error as small, but for 2 %."""
    best, front = math.inf, []
    for row in sorted(rows, key=lambda row: (row["updates_per_s"], row["position_p99_m"])):
        if row["position_p99_m"] < 0.98 * best:
            best = row["position_p99_m"]
            front.append(row)
    return front


def line_of(rows, model):
    return sorted((row["updates_per_s"], row["position_p99_m"]) for row in rows if row["model"] == model)


def rate_at(line, error):
    """Updates a second for an error, on the line between two points of log scales; none where it does not go there."""
    for (x1, y1), (x2, y2) in zip(line, line[1:]):
        if min(y1, y2) <= error <= max(y1, y2) and y1 != y2:
            return x1 * (x2 / x1) ** (math.log(error / y1) / math.log(y2 / y1))
    return None


def draw_frontier(program, target):
    picture = Picture(500, "What accuracy costs: error against updates, a line for each model",
                      "The owner sends when it is off by a threshold, small to large along each line. Down and left is better.",
                      "Velocity saves most of what static sends, acceleration some 40 % of the rest; "
                      "auto is on the front or near it.")
    for i, (motion, meaning, thresholds, error) in enumerate(FRONTIERS):
        rows = program.rows("--csv", f"--motion {motion} --for 60s --models {','.join(MODELS)} --curves snap --angle none "
                            f"--heartbeat 60s --thresholds {','.join(f'{t}m' for t in thresholds)}")
        box = (64 + 368 * i, 134, 306, 266)
        draw_front(picture, box, rows)
        rates = [(model, rate_at(line_of(rows, model), error)) for model in ("static", "fpw", "auto")]
        found = ", ".join(f"{model} {rate:.2g}" for model, rate in rates if rate) + " updates/s"
        picture.text(box[0], 104, meaning, "head")
        picture.text(box[0], 122, f"for {length(error)}: {found}", "soft")
    picture.text(14, 267, "p99 error of position", "soft", "middle", 'transform="rotate(-90 14 267)"')
    for i, model in enumerate(MODELS):
        x = 64 + 88 * i
        picture.path([(x, 474), (x + 28, 474)], model, 2, dashes(model))
        picture.text(x + 35, 478, model)
    picture.path([(606, 474), (634, 474)], "true", 9, 'stroke-linecap="round"')
    picture.text(646, 478, "Pareto front")
    picture.write(target)


def dashes(model):
    """The default is drawn over what it chose."""
    return 'stroke-dasharray="5 4"' if model == "auto" else ""


def length(metres):
    return f"{metres:g} m" if metres >= 0.1 else f"{metres * 1000:g} mm"


def steps(low, high):
    """1, 2 and 5 of each decade between both."""
    return [m * 10.0 ** e for e in range(-6, 4) for m in (1, 2, 5) if low <= m * 10.0 ** e <= high]


def draw_front(picture, box, rows):
    ends = [[f(row[key] for row in rows) for f in (min, max)] for key in ("updates_per_s", "position_p99_m")]
    x, y = [(low / 1.25, high * 1.25) for low, high in ends]
    plot = Plot(picture, box, x, y, True, True)
    plot.grid(steps(*x), steps(*y), lambda v: f"{v:g}", length)
    left, top, width, height = box
    picture.text(left + width / 2, top + height + 36, "updates a second", "soft", "middle")
    plot.path([(row["updates_per_s"], row["position_p99_m"]) for row in front_of(rows)], "true", 10,
              'stroke-linecap="round"')
    for model in MODELS:
        line = line_of(rows, model)
        plot.path(line, model, 2, dashes(model))
        for point in line:
            picture.dot(*plot.at(*point), model, 2)
    for model in ("static", "fpw", "auto"):
        nth = 5 if model == "auto" else 3
        point = line_of(rows, model)[nth]
        x, y = plot.at(*point)
        same = [other for other in MODELS if other != model and near(line_of(rows, other)[nth], point)]
        words = ", ".join([model] + same)
        if model == "auto":
            picture.text(x - 14, y + 6, words, "of auto", "end")
        else:
            picture.text(x + 10, y - 6, words, f"of {model}")


def near(a, b):
    """Whether two points look like one."""
    return all(abs(p / q - 1) < 0.04 for p, q in zip(a, b))


# --- a poor link ---

# Name, class, what it is, and where its label begins [s, m].
LINKED = (("rvw", "rvw", "rvw as sent: world acceleration, held constant", (4.4, 0.03)),
          ("rvw+adaptive", "adaptive", "rvw+adaptive: from the same updates the viewer chooses an order", (1.25, 4e-6)),
          ("auto", "auto", "auto: the owner chooses rpb, which turns; what is left is rounding on the wire", (1.25, 1e-6)))


def draw_circle(program, target):
    picture = Picture(446, "A steady turn over a poor link: error of what is shown",
                      "100 m radius at 20 m/s; an update each 0.2 s, 80 ms ±40 % under way, 10 % lost; curve cubic, 60 Hz.")
    plot = Plot(picture, (66, 72, 672, 310), (0, 10), (1e-9, 1e-1), log_y=True)
    names = {10.0 ** e: small(e) for e in range(-9, 0)}
    plot.grid(range(0, 11, 2), names, lambda t: f"{t} s", names.get)
    rows = []
    for model, kind, meaning, label in LINKED:
        rows = program.trace(f"--motion circle --for 10s --models {model} --curves cubic --period 200ms "
                             "--delay 80ms --jitter 40% --loss 10%")
        plot.path([(row["t_s"], max(row["error_m"], 1e-9)) for row in rows], kind, 1.6)
        x, y = plot.at(*label)
        picture.text(x, y, meaning, f"of {kind}")
    for before, now in zip(rows, rows[1:]):
        if now["lost"] > before["lost"]:
            draw_cross(picture, plot.at(now["t_s"], 1e-9)[0], 368)
    draw_cross(picture, 72, 425)
    picture.text(86, 429, "an update is lost, the same ones for all three: the errors of rvw grow until the next arrives")
    picture.write(target)


def small(exponent):
    """A power of ten of a metre."""
    unit, name = next(pair for pair in ((-3, "mm"), (-6, "µm"), (-9, "nm")) if exponent >= pair[0])
    return f"{10 ** (exponent - unit)} {name}"


def draw_cross(picture, x, y):
    for way in (-4, 4):
        picture.line(x - 4, y - way, x + 4, y + way, "lost", 'stroke-width="2"')


PICTURES = {"orders": draw_orders, "curves": draw_curves, "frontier": draw_frontier, "circle": draw_circle}


def main():
    if len(sys.argv) not in (2, 3):
        sys.exit(__doc__)
    program = pathlib.Path(sys.argv[1]).resolve()
    if not program.exists():
        sys.exit(f"{program} is missing; ./run build makes it")
    folder = pathlib.Path(sys.argv[2]) if len(sys.argv) == 3 else HERE
    for name, draw in PICTURES.items():
        target = folder / f"dead_reckoning_{name}.svg"
        draw(Program(program), target)
        print(target)


if __name__ == "__main__":
    main()
