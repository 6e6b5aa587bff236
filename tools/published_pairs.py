"""The page on pairs of bodies under the published time-driven method: figures 15 to 29 of V. Salnikov, D. Choi,
P. Karamian-Surville (Comput. Mech. 55 (2015) 127-144), with pictures of ours."""
from reproduction import ROOT, Pictures, new_plot, number, prose, table

PAGE = ROOT / "docs" / "algorithms" / "published_pairs.md"
PICTURES = Pictures(ROOT / "docs" / "images" / "published_pairs", most_bytes=60_000)
FORMS = ["before", "literal", "repaired", "exact"]
WORDS = {"literal": "as printed"}

# Where the camera stands [degrees]: so that the way apart lies across the picture.
ACROSS_X, ACROSS_Y, ACROSS_DIAGONAL = "20", "-55", "73"
AZIMUTHS = {15: ACROSS_DIAGONAL, 21: ACROSS_Y, 22: ACROSS_Y, 23: ACROSS_Y}

# Figure: what its caption says, and what happens here.
FIGURES = {
    15: ("two spheres", """They part along the line of their centers. The one line of Table I that is the same in both
         forms and in the exact method, but for where it stops."""),
    16: ("sphere and cylinder, symmetric, sc2", """Repaired: apart, across the axis, nothing turns. As printed sc2 pulls:
         the sphere is drawn onto the axis and swings there; it comes out only because the energy stagnates, and the
         Nose-Hoover thermostat, switched on for that, throws it out."""),
    17: ("the same, not symmetric, sc2; the cylinder turns", """Repaired: the end where the sphere stands turns away, as
         captioned. As printed: drawn in, turned about, thrown out elsewhere by the thermostat."""),
    18: ("sphere on the axis, sc2, then sc3", """Repaired: out through the base, along the axis, sc2 handing over to sc3.
         As printed the direction is 0/0: no force, no energy, and the method ends content before its first step, the
         sphere one and a half radii deep."""),
    19: ("sphere and base, sc3", """It leaves along the axis, and the base tilts under it. The same in both forms: sc3 is
         right as printed."""),
    20: ("sphere and rim of the base, sc4", """It leaves slantwise, and the cylinder turns. As printed the force is too
         long and acts off the cylinder: farther apart, less moved, more turned."""),
    21: ("two cylinders, symmetric, cc1", "Apart along their common normal; nothing turns."),
    22: ("two cylinders, cc1; one turns", """The one that is crossed off its middle turns; the other, crossed at its
         middle, does not."""),
    23: ("two cylinders, cc1; both turn", "Crossed off both middles, both turn, by the same angle."),
    24: ("axes in one plane, one base, cd1", "They part in that plane; nothing leaves it."),
    25: ("parallel axes, cc1 (degenerate) and cd2, then cd1", """Repaired: cc1 and cd2, then cc1 and cd1, as
         captioned. As printed cc1 needs a common normal that parallel axes do not have, and Algorithm 3, without a
         bound, adds cd3: they part nonetheless."""),
    26: ("axes not in one plane, one base, cd1", "The base that enters pushes and turns the face; cc1 takes over on the way."),
    27: ("axes not in one plane, one base, cd1", "As figure 26, from the other side, by cd1 alone."),
    28: ("two bases, d1 or d2", """Repaired: d1 beside cd1, then cd1 alone. As printed Algorithm 2 has a wrong sign and
         finds neither d1 nor d2; cd1, which is there too, parts them."""),
    29: ("axes that cross inside, cc1 (degenerate), then cd2, then cd1", """Repaired: cc1 along the line of centers,
         then cd2, then cd1, as captioned; the pair keeps to its plane. As printed the direction of cc1 is that of a
         rounding error, and cd3 joins in: both end turned far."""),
}


def draw(arguments):
    for figure in FIGURES:
        packings = [arguments.work / f"fig_{figure}_{form}.json" for form in FORMS]
        PICTURES.draw_beside(arguments.program, packings, f"fig_{figure}", "--width", "240", "--height", "240",
                             "--samples", "5", "--elevation", "15", "--azimuth", AZIMUTHS.get(figure, ACROSS_X))


def path(measured, figure, form):
    """(time, gap) at every step."""
    return [(float(time), float(gap)) for time, gap in measured.rows("pairs", "path", str(figure), form)]


def plot(measured):
    """The gap of each pair against time, a panel each."""
    from matplotlib import pyplot
    new_plot()
    figure, axes = pyplot.subplots(3, 5, figsize=(9, 5), sharey=True)
    for axis, number_of in zip(axes.flat, FIGURES):
        for form, style in (("literal", "C3-"), ("repaired", "C0o-")):
            points = path(measured, number_of, form)[:25]
            axis.plot(*zip(*points), style, ms=3, lw=1, label=WORDS.get(form, form))
            if len(points) < 25 and points[-1][1] < 0:
                axis.axhline(points[-1][1], color=style[:2], ls=":")
        axis.axhline(0, color="k", lw=0.8)
        axis.set_title(str(number_of), fontsize=9)
        axis.tick_params(labelsize=7)
    axes[0][0].legend(fontsize=6)
    for axis in axes[-1]:
        axis.set_xlabel("t / T", fontsize=8)
    for row in axes:
        row[0].set_ylabel("gap / radius", fontsize=8)
    PICTURES.save(figure, "gaps")


def head():
    return ["# Pairs under the published time-driven method", "", *prose("""
        V. Salnikov, D. Choi and P. Karamian-Surville (Comput. Mech. 55 (2015) 127-144) validate the [dynamics of
        their method](published_time_driven.md) by pictures of two bodies before and after, figures 15 to 29. Captions
        tell the type of intersection and who turns; sizes and places are not given. Those here are ours: spheres and
        cylinders of radius 1 (in figure 15 a sphere of 0.5), cylinders 6 long, placed so that the types are those of
        the captions."""), *prose("""
        Each strip: before; as printed; repaired; and, to compare with, the [exact relaxation](relaxation.md). A gap
        is the distance of the surfaces, less than 0 where they overlap [radius]. Every picture and number was written
        by `make reproduce-salnikov`; what the text says of the repaired form is what `test_published_pairs.cpp`
        asserts.""")]


def sections(measured):
    lines = []
    for figure, (caption, text) in FIGURES.items():
        lines += [f"## Figure {figure}: {caption}", "",
                  PICTURES.mark(f"fig_{figure}", f"figure {figure}: before, as printed, repaired, exact", PAGE), "",
                  *prose(text)]
    return lines


def row_of(measured, figure, form):
    words = measured.rows("pairs", "pair", str(figure), form)[0]
    types, start, end, _, moved, turned_a, turned_b, steps, reshuffles = words
    return [figure, WORDS.get(form, form), types.replace(">", ", ").replace("+", " + "),
            number(start), number(end), number(moved), f"{turned_a}, {turned_b}", steps,
            reshuffles if reshuffles != "0" else ""]


def page(measured, plots):
    lines = head() + sections(measured)
    lines += ["## Gaps against time", "", *([PICTURES.mark("gaps", "gaps of all pairs against time", PAGE), ""]
                                            if plots else []), *prose("""
        Steps of 0.1 T, the first 25 of them. A curve ends where the method sees no overlap any more, and stops;
        dotted where it stops in overlap. A force that pulls (figures 16 and 17, as printed) or is none (18) shows at
        once."""),
              "## Numbers", "", *prose("""
        Types: those that the tests find on the way; "...": more than 300 steps, not all looked at. Moved: each body,
        as momentum is kept [radius]. Turned: first and second body [degrees]. Reshuffles: times that the Nose-Hoover
        thermostat was switched on. Steps of the exact method are those of its descent, which ends at a gap and not at
        rest."""),
              *table(["figure", "form", "types", "gap before", "after", "moved", "turned", "steps", "reshuffles"],
                     [row_of(measured, figure, form) for figure in FIGURES for form in FORMS[1:]])]
    return lines + ["## One that is not seen", "", *prose("""
        Repaired, no pair of these figures stays in overlap. Others do: two cylinders nearly at right angles, 0.8
        radii deep, for which Algorithm 3 looks at a rim point beside the overlap, and the method ends before its
        first step. That pair is in `test_published_pairs.cpp`; how often it happens is in
        [published_cylinder_tests.md](published_cylinder_tests.md), what it does to packings in
        [published_time_driven.md](published_time_driven.md#measured)."""),
                    *prose("Again: `bench_time_driven pairs FOLDER` prints the numbers and writes the packings.")]
