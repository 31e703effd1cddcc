#!/usr/bin/python3
"""Figures and pages of whirl_twin.drawing: their data, labels, sizes and files, and the errors of wrong requests.

usage: PYTHONPATH=python drawing_test.py
"""
import json
import math
import os
import re
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree as ElementTree

try:
    import jinja2  # noqa: F401
    import matplotlib
    import numpy as np
except ImportError as error:
    print(f"skipped: {error}")
    sys.exit(77)

from whirl_twin import drawing

SVG = "{http://www.w3.org/2000/svg}"


def chart(series, **more):
    return {"x": {"label": "time (s)"}, "y": {"label": "x (m)"}, "series": series, **more}


def series(x, y, **more):
    return {"x": list(x), "y": list(y), **more}


def figure(*charts, **more):
    return {"kind": "charts", "title": "a figure", "charts": list(charts), **more}


def axes_of(*charts, **more):
    """The axes of a drawn figure, one for each chart."""
    return drawing.draw(figure(*charts, **more)).axes


def labels(axis):
    """Texts of the visible tick labels."""
    low, high = sorted(axis.get_view_interval())
    slack = 1e-6 * (high - low)
    return [label.get_text() for tick, label in zip(axis.get_majorticklocs(), axis.get_ticklabels())
            if low - slack <= tick <= high + slack]


def svg_of(content):
    """The root of a figure's SVG, and its bytes."""
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "figure.svg")
        drawing.save(content, path, "svg")
        with open(path, "rb") as file:
            contents = file.read()
    return ElementTree.fromstring(contents), contents


def texts_of(root):
    return [element.text for element in root.iter(SVG + "text")]


RAMP = series(range(11), [0.1 * i for i in range(11)], name="ramp")
ROD = {"from": [0, 0, 0], "to": [1, 0, 0], "radius": 0.05}


def map_figure(**more):
    return {"kind": "map", "title": "a map", "x": {"label": "k (N/m)"}, "y": {"label": "c (N s/m)"}, "label": "peak (m)",
            "x_levels": [1, 2, 4], "y_levels": [10, 20], "values": [[0, 1, 2], [2, 3, None]], **more}


def bars_figure():
    return {"kind": "bars", "title": "weights", "subtitle": "of 10 %", "x": {"label": "peak (m)"}, "names": ["low", "high"],
            "base": 2.0, "groups": [
                {"name": "first", "bars": [{"value": 1.0, "low": 0.8, "high": 1.1}, {"value": 4.0}]},
                {"name": "second", "bars": [{"value": 1.5}, {"value": None}]}]}


def sketch_figure(sketch, **more):
    return {"kind": "sketch", "title": "a sketch", "sketch": sketch, **more}


ALL_KINDS = (figure(chart([RAMP])), bars_figure(), map_figure(), sketch_figure({"rods": [ROD]}))


class Charts(unittest.TestCase):
    def test_a_line_has_the_data_of_its_series(self):
        (ax,) = axes_of(chart([RAMP, series([1, 2], [3, 4])]))
        np.testing.assert_array_equal(ax.lines[0].get_xydata(), np.column_stack((RAMP["x"], RAMP["y"])))
        np.testing.assert_array_equal(ax.lines[1].get_xydata(), [[1, 3], [2, 4]])

    def test_labels_and_titles_are_those_of_the_request(self):
        drawn = drawing.draw(figure(chart([RAMP], title="a chart")))
        (ax,) = drawn.axes
        self.assertEqual(drawn._suptitle.get_text(), "a figure")
        self.assertEqual(ax.get_title(), "a chart")
        self.assertEqual((ax.get_xlabel(), ax.get_ylabel()), ("time (s)", "x (m)"))

    def test_null_infinite_and_huge_values_interrupt_a_line(self):
        (ax,) = axes_of(chart([series(range(5), [1, None, 2, float("inf"), 1e301])]))
        np.testing.assert_array_equal(np.isfinite(ax.lines[0].get_ydata()), [True, False, True, False, False])
        self.assertLessEqual(ax.get_ylim()[1], 3)

    def test_a_point_between_two_gaps_is_a_dot(self):
        (ax,) = axes_of(chart([series(range(6), [1, 2, None, 3, None, 1])]))
        self.assertEqual(ax.lines[0].get_markevery(), [3, 5])

    def test_not_positive_values_interrupt_a_line_on_a_logarithmic_axis(self):
        (ax,) = axes_of(chart([series([1, 2, 3, 4], [10, 0, -1, 1000])], y={"logarithmic": True}))
        self.assertEqual(ax.get_yscale(), "log")
        np.testing.assert_array_equal(np.isfinite(ax.lines[0].get_ydata()), [True, False, False, True])
        self.assertEqual(ax.get_ylim(), (10, 1000))
        self.assertIn("100", labels(ax.yaxis))

    def test_second_scale_is_the_first_times_its_factor(self):
        axis = {"label": "speed (rad/s)", "tight": True, "second": {"label": "rpm", "factor": 30 / math.pi}}
        (ax,) = axes_of(chart([series([0, 100], [0, 1])], x=axis))
        ax.figure.savefig(os.devnull, format="png")
        (second,) = ax.child_axes
        self.assertAlmostEqual(second.get_xlim()[1], 100 * 30 / math.pi)
        self.assertEqual(second.get_xlabel(), "rpm")
        self.assertIn("400", labels(second.xaxis))

    def test_a_tight_axis_ends_with_the_data_another_at_a_tick(self):
        data = [series([0.13, 9.7], [0.13, 9.7])]
        (ax,) = axes_of(chart(data, x={"tight": True}))
        self.assertEqual(ax.get_xlim(), (0.13, 9.7))
        self.assertEqual(ax.get_ylim(), (0, 10))

    def test_an_inverted_axis_falls(self):
        (ax,) = axes_of(chart([series([0, 1], [0, 180])], y={"inverted": True, "degrees": True}))
        self.assertEqual(ax.get_ylim(), (180, 0))
        (ax,) = axes_of(chart([series([0, 1], [0, 180])], x={"inverted": True}))
        self.assertEqual(ax.get_xlim(), (1, 0))

    def test_degrees_have_ticks_at_fractions_of_a_turn(self):
        (ax,) = axes_of(chart([series([0, 1], [0, 180])], y={"degrees": True}))
        self.assertEqual(labels(ax.yaxis), ["0", "45", "90", "135", "180"])
        (ax,) = axes_of(chart([series([0, 1], [-360, 360])], y={"degrees": True}), chart_height=200)
        self.assertTrue(all(int(tick) % 90 == 0 for tick in ax.yaxis.get_majorticklocs()))

    def test_one_exponent_per_axis(self):
        (ax,) = axes_of(chart([series([0, 1], [0, 3e-4])]))
        self.assertEqual(labels(ax.yaxis)[-1], "300")
        self.assertEqual(ax.get_ylabel(), "x (µm)")
        self.assertEqual(ax.yaxis.get_major_formatter().get_offset(), "")
        for label, scaled in (("U (kg m)", "U (10⁻⁶ kg m)"), ("A (m^2)", "A (10⁻⁶ m^2)"), ("M (N m)", "M (µN m)"),
                              ("decrement of 1", "decrement of 1 (10⁻⁶)"), ("", "10⁻⁶")):
            (ax,) = axes_of(chart([series([0, 1], [0, 3e-4])], y={"label": label}))
            self.assertEqual(ax.get_ylabel(), scaled)
        (ax,) = axes_of(chart([series([0, 1], [0, 3e5])], y={"label": "time (s)"}))
        self.assertEqual(ax.get_ylabel(), "time (10³ s)")
        both = axes_of(chart([series([0, 1], [0, 1])], x={"second": {"label": "rpm", "factor": 1e6}}))[0]
        both.figure.savefig(os.devnull, format="png")
        self.assertEqual(both.child_axes[0].get_xlabel(), "10⁶ rpm")
        self.assertEqual(labels(both.child_axes[0].xaxis)[-1], "1.0")

    def test_bands_cover_their_range_inside_the_axes(self):
        bands = [{"name": "danger", "low": 2, "high": 3, "color": "#ff0000"}, {"low": 9, "high": 99, "color": "#00ff00"}]
        (ax,) = axes_of(chart([RAMP], bands=bands))
        ends = [(patch.get_xy()[:, 0].min(), patch.get_xy()[:, 0].max()) for patch in ax.patches]
        self.assertEqual(ends, [(2, 3), (9, 10)])

    def test_equal_aspect_means_equal_scales(self):
        (ax,) = axes_of(chart([series([0, 3], [0, 1])], equal_aspect=True))
        box = ax.get_window_extent()
        across = box.width / (ax.get_xlim()[1] - ax.get_xlim()[0])
        up = box.height / (ax.get_ylim()[1] - ax.get_ylim()[0])
        self.assertAlmostEqual(across / up, 1.0)
        steps = [np.diff(axis.get_majorticklocs())[0] for axis in (ax.xaxis, ax.yaxis)]
        self.assertAlmostEqual(*steps)

    def test_forty_series_have_forty_pens(self):
        (ax,) = axes_of(chart([series([0, 1], [i, i + 1], name=f"series {i}") for i in range(40)]))
        pens = {(line.get_color(), str(line._unscaled_dash_pattern)) for line in ax.lines}
        self.assertEqual(len(pens), 40)

    def test_a_pen_of_a_series_is_used(self):
        pen = {"color": "#123456", "width": 5, "dash": [4, 2]}
        (ax,) = axes_of(chart([{**RAMP, "pen": pen}]))
        self.assertEqual(ax.lines[0].get_color(), "#123456")
        self.assertAlmostEqual(ax.lines[0].get_linewidth(), 5 * 0.72)
        self.assertEqual(ax.lines[0].get_linestyle(), "--")

    def test_charts_are_in_rows_and_columns(self):
        axes = axes_of(*[chart([RAMP])] * 3, columns=2, width=900, chart_height=300)
        places = [ax.get_position() for ax in axes]
        self.assertAlmostEqual(places[0].y0, places[1].y0)
        self.assertAlmostEqual(places[0].x0, places[2].x0)
        self.assertGreater(places[0].y0, places[2].y1)
        self.assertEqual(axes[0].figure.get_size_inches()[0], 9)

    def test_a_legend_explains_each_look_once(self):
        pair = [{**RAMP, "name": "a"}, {**RAMP, "name": "b"}]
        first, again, more = axes_of(chart(pair), chart(pair), chart([*pair, {**RAMP, "name": "c"}]))
        names = [[text.get_text() for legend in ax.get_children() if isinstance(legend, matplotlib.legend.Legend)
                  for text in legend.get_texts()] for ax in (first, again, more)]
        self.assertEqual(names, [["a", "b"], [], ["c"]])

    def test_a_line_that_fills_its_chart_is_finer(self):
        t = np.linspace(0, 1, 20000)
        (ax,) = axes_of(chart([series(t, np.sin(3000 * t)), series(t, np.sin(10 * t))]))
        self.assertLess(ax.lines[0].get_linewidth(), 0.5 * ax.lines[1].get_linewidth())

    def test_a_coarse_orbit_is_drawn_round_and_a_square_with_corners(self):
        from whirl_twin.drawing.thinning import smooth

        turns = np.arange(40) * math.pi / 4
        (ax,) = axes_of(chart([series(np.cos(turns), np.sin(turns)), series([0, 1, 1, 0, 0, 1], [0, 0, 1, 1, 0, 0])],
                              equal_aspect=True))
        smooth(ax.figure)
        radius = np.hypot(*ax.lines[0].get_data())
        self.assertGreater(len(radius), 200)
        np.testing.assert_allclose(radius[10:-10], 1.0, atol=0.02)
        self.assertEqual(len(ax.lines[1].get_xdata()), 6)

    def test_legends_are_above_the_chart(self):
        drawn = drawing.draw(figure(chart([{**RAMP, "name": f"a long name of a series {i}"} for i in range(9)])))
        (ax,) = drawn.axes
        drawn.savefig(os.devnull, format="png")
        boxes = [child.get_window_extent() for child in ax.get_children()
                 if isinstance(child, matplotlib.legend.Legend)]
        self.assertEqual(len(boxes), 1)
        for box in boxes:
            self.assertGreater(box.y0, ax.get_window_extent().y1)
            self.assertLess(box.x1, drawn.bbox.x1)
            self.assertLess(box.y1, drawn.bbox.y1)

    def test_labels_cover_neither_curves_nor_each_other(self):
        x = np.linspace(0, 100, 500)
        lines = [{"at": at, "label": f"critical speed {i}"} for i, at in enumerate((20, 50, 53, 80))]
        notes = [{"x": x[i], "y": math.sin(x[i] / 10), "text": f"note {i}"} for i in (60, 200, 333)]
        (ax,) = axes_of(chart([series(x, np.sin(x / 10))], vertical=lines, notes=notes))
        ax.figure.savefig(os.devnull, format="png")
        boxes = [text.get_window_extent() for text in ax.texts]
        self.assertEqual(len(boxes), 7)
        curve = ax.transData.transform(ax.lines[0].get_xydata())
        for i, box in enumerate(boxes):
            self.assertEqual(box.count_contains(curve), 0, ax.texts[i].get_text())
            self.assertEqual(box.count_overlaps(boxes[i + 1:]), 0, ax.texts[i].get_text())

    def test_axes_of_the_caller_are_used(self):
        from matplotlib.figure import Figure

        ax = Figure().add_subplot()
        for content in ALL_KINDS:
            own = Figure().add_subplot()
            self.assertIs(drawing.draw(content, own), own.figure)
        drawing.draw(figure(chart([RAMP]), chart([])), ax)
        self.assertEqual(len(ax.lines[0].get_xdata()), 11)
        self.assertEqual(len(ax.figure.axes), 1)

    def test_any_numbers_can_be_drawn(self):
        rows = ([], [1.0], [5, 5, 5], [-1e300, 1e300], [1e-300, 2e-300], [None, None], [1e6, 1e6 + 1e-4],
                [float("nan"), float("inf")], [1e-200, 3e-200], [10 ** 400, 1])
        for logarithmic, equal in ((False, False), (True, False), (False, True)):
            charts = [chart([series(range(len(row)), row), series(row, row)], x={"logarithmic": logarithmic},
                            y={"logarithmic": logarithmic}, equal_aspect=equal,
                            notes=[{"x": 1, "y": 5, "text": "note"}], vertical=[{"at": 1, "label": "line"}])
                      for row in rows]
            svg_of(figure(*charts, columns=4, width=1600, chart_height=200))


class Overlays(unittest.TestCase):
    def test_curves_of_all_figures_are_in_one_with_their_names(self):
        other = figure(chart([series([0, 5], [2, 3], name="ramp")], title="its own"), title="another")
        drawn = drawing.draw(drawing.overlaid({"model": figure(chart([RAMP])), "measured": other}))
        (ax,) = drawn.axes
        self.assertEqual([line.get_label() for line in ax.lines], ["model", "measured"])
        np.testing.assert_array_equal(ax.lines[1].get_xydata(), [[0, 2], [5, 3]])
        self.assertNotEqual(ax.lines[0].get_color(), ax.lines[1].get_color())
        self.assertNotEqual(ax.lines[0].get_linestyle(), ax.lines[1].get_linestyle())
        self.assertEqual(drawn._suptitle.get_text(), "a figure and another")

    def test_several_curves_keep_their_colours_and_get_the_dashes_of_their_figure(self):
        pair = [{**RAMP, "name": "x"}, {**RAMP, "name": "y"}]
        (ax,) = drawing.draw(drawing.overlaid({"a": figure(chart(pair)), "b": figure(chart(pair))})).axes
        self.assertEqual([line.get_label() for line in ax.lines], ["a, x", "a, y", "b, x", "b, y"])
        colors = [line.get_color() for line in ax.lines]
        self.assertEqual(colors[:2], colors[2:])
        self.assertEqual([line.is_dashed() for line in ax.lines], [False, False, True, True])

    def test_other_axes_are_an_error(self):
        for other, wrong in ((figure(chart([RAMP], y={"label": "y (m)"})), "b: axes as in a are required"),
                             (figure(chart([RAMP]), chart([RAMP])), "b: charts as in a are required"),
                             (bars_figure(), "b: charts are required, found a figure of kind bars")):
            with self.assertRaisesRegex(drawing.RequestError, wrong):
                drawing.overlaid({"a": figure(chart([RAMP])), "b": other})


class Bars(unittest.TestCase):
    def test_bars_run_from_the_base_to_their_values_in_order(self):
        (ax,) = drawing.draw(bars_figure()).axes
        bars = [(patch.get_x(), patch.get_x() + patch.get_width()) for patch in ax.patches]
        self.assertEqual(bars, [(2, 1), (2, 4), (2, 1.5)])
        names = [label.get_text() for label in ax.get_yticklabels()]
        self.assertEqual(names, ["first", "second"])
        self.assertGreater(ax.get_ylim()[0], ax.get_ylim()[1])  # the first at the top

    def test_an_interval_is_a_line(self):
        (ax,) = drawing.draw(bars_figure()).axes
        np.testing.assert_array_equal(ax.lines[0].get_xdata(), [0.8, 1.1])


class Maps(unittest.TestCase):
    def test_cells_have_their_values_and_holes(self):
        ax = drawing.draw(map_figure()).axes[0]
        cells = ax.collections[0].get_array().reshape(2, 3)
        np.testing.assert_array_equal(cells.mask, [[False] * 3, [False, False, True]])
        np.testing.assert_array_equal(cells.compressed(), [0, 1, 2, 2, 3])

    def test_a_hole_is_in_the_legend_and_only_then(self):
        self.assertIn("failed or undefined", texts_of(svg_of(map_figure())[0]))
        whole = map_figure(values=[[0, 1, 2], [2, 3, 4]])
        self.assertNotIn("failed or undefined", texts_of(svg_of(whole)[0]))

    def test_a_contour_is_linear_between_grid_points(self):
        contour = {"at": 1.5, "label": "limit"}
        content = map_figure(values=[[0, 1, 2], [0, 1, 2]], contours=[contour])
        ax = drawing.draw(content).axes[0]
        (line,) = [path for collection in ax.collections[1:] for path in collection.get_paths()]
        np.testing.assert_allclose(line.vertices[:, 0], 3.0)  # half-way from 2 to 4
        self.assertIn("limit", texts_of(svg_of(content)[0]))

    def test_rows_that_do_not_fit_are_an_error(self):
        with self.assertRaisesRegex(drawing.RequestError, "figure.values: 2 rows of 3 numbers"):
            drawing.draw(map_figure(values=[[1, 2, 3]]))
        with self.assertRaisesRegex(drawing.RequestError, "figure.x_levels: two or more increasing"):
            drawing.draw(map_figure(x_levels=[1, 4, 2]))


class Sketches(unittest.TestCase):
    def extent(self, sketch, **more):
        """Of the drawn patches [m]: left, right, bottom, top; and the axes."""
        (ax,) = drawing.draw(sketch_figure(sketch, **more)).axes
        xy = np.concatenate([patch.get_path().transformed(patch.get_patch_transform()).vertices for patch in ax.patches])
        return [*np.column_stack((xy.min(axis=0), xy.max(axis=0))).ravel()], ax

    def test_parts_are_where_they_are_and_as_large(self):
        (left, right, bottom, top), ax = self.extent({"balls": [{"at": [1, 0, 2], "radius": 0.5}]})
        np.testing.assert_allclose((left, right, bottom, top), (0.5, 1.5, 1.5, 2.5), atol=1e-3)
        box = ax.get_window_extent()
        self.assertAlmostEqual(box.width / np.diff(ax.get_xlim())[0], box.height / np.diff(ax.get_ylim())[0])

    def test_all_parts_are_on_the_sheet(self):
        sketch = {"rods": [ROD], "discs": [{"at": [0.5, 0, 0], "axis": [1, 0, 0], "radius": 0.4, "thickness": 0.1}],
                  "boxes": [{"at": [0, 0, -1], "size": [0.1, 0.1, 0.3], "pitch": 0.3}],
                  "springs": [{"from": [1, 0, -1], "to": [1, 0, 0], "radius": 0.05}],
                  "dampers": [{"from": [0.5, 0, -1], "to": [0.5, 0, 0], "radius": 0.05}],
                  "arrows": [{"from": [0, 0, 0], "to": [0, 0, 1]}],
                  "lines": [{"points": [[-2, 0, -1], [2, 0, -1]], "role": "support"}]}
        for spatial in (False, True):
            (left, right, bottom, top), ax = self.extent({**sketch, "spatial": spatial}, ghosts=[sketch])
            self.assertLess(ax.get_xlim()[0], left)
            self.assertGreater(ax.get_xlim()[1], right)
            self.assertLess(ax.get_ylim()[0], bottom)
            self.assertGreater(ax.get_ylim()[1], top)

    def test_a_spatial_sketch_is_seen_raised_and_turned(self):
        (left, right, _, _), _ = self.extent({"balls": [{"at": [1, 0, 0], "radius": 0.1}], "spatial": True})
        self.assertAlmostEqual(0.5 * (left + right), math.cos(0.30), places=3)
        (_, _, bottom, top), _ = self.extent({"balls": [{"at": [0, 0, 1], "radius": 0.1}], "spatial": True})
        self.assertAlmostEqual(0.5 * (bottom + top), math.cos(0.35), places=3)

    def test_what_is_nearer_covers_what_is_farther(self):
        balls = [{"at": [0, y, 0], "radius": 1 + 0.1 * y} for y in (0, -1, 1)]
        (ax,) = drawing.draw(sketch_figure({"balls": balls})).axes
        large = sorted((p for p in ax.patches if p.radius > 0.5), key=lambda p: p.get_zorder())
        self.assertEqual([round(patch.radius, 3) for patch in large], [1.1, 1.0, 0.9])

    def test_the_mark_of_a_disc_turns_with_its_angle(self):
        for angle, direction in ((0.0, (0.0, 1.0)), (math.pi / 2, (1.0, 0.0))):
            # Its axis points away from the eye: seen from its back, it turns to the right.
            disc = {"at": [0, 0, 0], "axis": [0, 1, 0], "radius": 2, "thickness": 0.1, "angle": angle}
            (ax,) = drawing.draw(sketch_figure({"discs": [disc]})).axes
            spoke = next(line for line in ax.lines if line.get_gid() is None).get_xydata()
            np.testing.assert_allclose((spoke[1] - spoke[0]) / 2, direction, atol=1e-9)

    def test_the_scale_bar_is_as_long_as_its_label(self):
        (ax,) = drawing.draw(sketch_figure({"rods": [ROD]}, note="at rest")).axes
        bar = next(line for line in ax.lines if line.get_gid() == "scale_bar").get_xdata()
        label = next(text.get_text() for text in ax.figure.texts if text.get_text().endswith(" m"))
        self.assertAlmostEqual(max(bar) - min(bar), float(label[:-2]))
        self.assertIn("at rest", [text.get_text() for text in ax.figure.texts])

    def test_an_empty_or_endless_sketch_is_an_error(self):
        with self.assertRaisesRegex(drawing.RequestError, "one part or more"):
            drawing.draw(sketch_figure({}))
        with self.assertRaisesRegex(drawing.RequestError, "within 1e\\+100 m"):
            drawing.draw(sketch_figure({"balls": [{"at": [1e101, 0, 0], "radius": 1}]}))
        with self.assertRaisesRegex(drawing.RequestError, "within 1e\\+100 m"):
            drawing.draw(sketch_figure({"balls": [{"at": [None, 0, 0], "radius": 1}]}))


class Files(unittest.TestCase):
    def test_texts_are_elements_of_an_svg_as_they_are(self):
        content = figure(chart([{**RAMP, "name": "50 $ & <more>"}, {**RAMP, "name": "$x^2$"}], title="2 < 3 & \"4\"",
                               vertical=[{"at": 4, "label": "line $1$"}], notes=[{"x": 5, "y": 0.5, "text": "a note"}]))
        root, _ = svg_of(content)
        texts = texts_of(root)
        for text in ("a figure", "2 < 3 & \"4\"", "50 $ & <more>", "$x^2$", "line $1$", "a note", "time (s)", "x (m)"):
            self.assertEqual(texts.count(text), 1, text)
        self.assertEqual(root.find(SVG + "title").text, "a figure")

    def test_every_svg_is_well_formed_whatever_its_texts(self):
        hostile = "]]> <a>&\x00\x1b\ud800\uffff 轴 \U0001f600"
        for content in ALL_KINDS:
            root, contents = svg_of({**content, "title": hostile})
            self.assertEqual(root.tag, SVG + "svg")
            self.assertNotIn(b"http", re.sub(rb'xmlns(:\w+)?="[^"]*"', b"", contents))

    def test_the_same_figure_gives_the_same_bytes(self):
        kinds = [("svg", content) for content in ALL_KINDS] + [("png", ALL_KINDS[0]), ("pdf", ALL_KINDS[0])]
        with tempfile.TemporaryDirectory() as folder:
            files = []
            for _ in range(2):
                paths = [os.path.join(folder, str(i)) for i in range(len(kinds))]
                self.assertEqual((0, ""), run({"drawings": [
                    {"path": path, "format": kind, "figure": content} for path, (kind, content) in zip(paths, kinds)]}))
                files.append([])
                for path in paths:
                    with open(path, "rb") as file:
                        files[-1].append(file.read())
            self.assertEqual(*files)

    def test_a_png_has_144_px_per_inch_and_a_pdf_its_title(self):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "file")
            drawing.save(figure(chart([RAMP])), path, "png")
            with open(path, "rb") as file:
                head = file.read(24)
            self.assertEqual(head[:4], b"\x89PNG")
            self.assertEqual(int.from_bytes(head[16:20], "big"), 1152)
            drawing.save(figure(chart([RAMP])), path, "pdf")
            with open(path, "rb") as file:
                self.assertIn(b"/Title (a figure)", file.read())

    def test_a_hundred_thousand_points_make_200_kilobytes(self):
        rng = np.random.default_rng(1)
        t = np.arange(100000) * 1e-3
        noise = rng.normal(size=len(t))
        for x, y, more in ((t, noise, {}), (t[::-1], noise, {}), (np.cos(7 * t), np.sin(7.01 * t), {}),
                           (np.cumsum(noise), np.cumsum(rng.normal(size=len(t))), {}),
                           (t, np.where(np.arange(len(t)) % 2, np.nan, np.sin(t)), {}),
                           (t, noise, {"line": False, "marks": "dots"})):
            _, contents = svg_of(figure({"series": [{"x": x, "y": y, **more}]}))
            self.assertLess(len(contents), 200e3)

    def test_thinning_keeps_the_peaks_of_a_long_series(self):
        from whirl_twin.drawing.output import svg

        y = np.zeros(100000)
        y[12345], y[54321] = 1.0, -0.5
        drawn = drawing.draw(figure({"series": [{"x": np.arange(100000.0), "y": y}]}))
        svg(drawn)
        kept = drawn.axes[0].lines[0].get_ydata()
        self.assertLess(len(kept), 10000)
        self.assertAlmostEqual(kept.max(), 1.0)
        self.assertAlmostEqual(kept.min(), -0.5)

    def test_long_texts_stay_on_the_sheet(self):
        long = "a very long text " * 12
        content = figure(chart([{**RAMP, "name": long}, {**RAMP, "name": "b"}], title=long, x={"label": long},
                               y={"label": long}), title=long)
        for content in (content, {**bars_figure(), "title": long, "subtitle": long}, {**map_figure(), "title": long},
                        sketch_figure({"rods": [ROD]}, note=long)):
            drawn = drawing.draw(content)
            drawn.savefig(os.devnull, format="png")
            for text in drawn.findobj(matplotlib.text.Text):
                if text.get_visible() and text.get_text().strip().startswith("a very"):
                    box = text.get_window_extent()
                    self.assertGreaterEqual(box.x0, -3, content["kind"])
                    self.assertLessEqual(box.x1, drawn.bbox.x1 + 3, content["kind"])
                    self.assertGreaterEqual(box.y0, -3, content["kind"])
                    self.assertLessEqual(box.y1, drawn.bbox.y1 + 3, content["kind"])


BAD = "<script>alert(1)</script>"


class Pages(unittest.TestCase):
    PAGE = {"title": "page" + BAD, "summary": ["sum" + BAD], "facts": [["scene" + BAD, "demo" + BAD]],
            "parts": [{"section": "s" + BAD}, {"part": "p" + BAD}, {"text": "t" + BAD}, {"list": ["l" + BAD]},
                      {"table": {"head": ["h" + BAD, "value"], "rows": [
                          ["c" + BAD, "-1.5e3"], [{"text": "d" + BAD, "class": "danger"}, "+2 mm"]]}},
                      {"figure": figure(chart([{**RAMP, "name": "f" + BAD}, RAMP], title="g" + BAD))},
                      {"figure": {**map_figure(), "title": "m" + BAD}}]}

    def test_every_text_is_escaped(self):
        page = drawing.page_html(self.PAGE)
        self.assertNotIn("<script", page)
        for start in ("page", "sum", "scene", "demo", "s", "p", "t", "l", "h", "c", "d", "f", "g", "m"):
            self.assertRegex(page, ">[^<]*" + start + "&lt;script&gt;alert\\(1\\)&lt;/script&gt;")

    def test_numbers_are_aligned_and_classes_kept(self):
        page = drawing.page_html(self.PAGE)
        self.assertEqual(re.findall(r'<td class="n ?">([^<]*)</td>', page), ["-1.5e3", "+2 mm"])
        self.assertEqual(len(re.findall(r'<td class="danger">', page)), 1)

    def test_figures_are_inside_with_identifiers_of_their_own(self):
        page = drawing.page_html({"title": "t", "parts": [{"figure": map_figure()}] * 2})
        self.assertEqual(page.count("<svg"), 2)
        names = re.findall(r'\bid="([^"]*)"', page)
        self.assertEqual(len(names), len(set(names)))
        used = re.findall(r'(?:href="#|url\(#)([^")]+)', page)
        self.assertTrue(used)
        self.assertLessEqual(set(used), set(names))
        self.assertEqual(re.findall(r'(?:src|href)="(?!#|data:)[^"]*"', page), [])

    def test_a_page_of_texts_needs_no_matplotlib(self):
        program = ("import sys; sys.modules['matplotlib'] = None; from whirl_twin import drawing; "
                   "print(drawing.page_html({'title': 'plain', 'parts': [{'text': 'a text'}]}))")
        done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True)
        self.assertIn("<p>a text</p>", done.stdout)


def run(request, *options):
    """Status and standard error of the program."""
    text = request if isinstance(request, str) else json.dumps(request)
    done = subprocess.run([sys.executable, *(options or ("-m", "whirl_twin.drawing"))], input=text, capture_output=True,
                          text=True)
    return done.returncode, done.stderr


class Program(unittest.TestCase):
    def test_a_request_writes_its_files(self):
        with tempfile.TemporaryDirectory() as folder:
            drawings = [{"path": os.path.join(folder, "a.tmp"), "format": "svg", "figure": figure(chart([RAMP]))},
                        {"path": os.path.join(folder, "b.tmp"), "format": "html", "page": {"title": "Überschrift"}}]
            self.assertEqual(run({"drawings": drawings}), (0, ""))
            with open(drawings[0]["path"], encoding="utf-8") as file:
                self.assertTrue(file.read().startswith("<svg"))
            with open(drawings[1]["path"], encoding="utf-8") as file:
                self.assertIn("<h1>Überschrift</h1>", file.read())

    def test_a_wrong_request_is_one_line_that_names_the_field(self):
        def one(content, kind="svg"):
            return {"drawings": [{"path": os.devnull, "format": kind, "figure": content}]}

        for request, start in (
                ("{", "request: JSON is required, found "),
                ([], "request: a set of fields is required, found []"),
                ({}, "request.drawings: a value is required, found nothing"),
                (one({}), "drawings[0].figure.kind: one of charts, bars, map, sketch is required, found nothing"),
                (one({}, "gif"), "request.drawings[0].format: one of svg, png, pdf, html is required, found 'gif'"),
                (one(figure({"series": [{"x": [1, "2"], "y": [1, 2]}]})),
                 "drawings[0].figure.charts[0].series[0].x[1]: a number is required, found '2'"),
                (one(figure({"series": [{"x": [1], "y": [1, 2]}]})),
                 "drawings[0].figure.charts[0].series[0]: x and y of equal length are required, found 1 and 2"),
                (one(figure({"bands": [{"low": 1, "high": 2, "color": "red"}]})),
                 "drawings[0].figure.charts[0].bands[0].color: a colour as #rrggbb is required, found 'red'"),
                (one(figure({"legend": 1})), "drawings[0].figure.charts[0]: one of the fields title, "),
                (one(figure(columns=0)), "drawings[0].figure.columns: a number from 1 to 12 is required, found 0"),
                (one(sketch_figure({"balls": [{"at": [0, 0], "radius": 1}]})),
                 "drawings[0].figure.sketch.balls[0].at: a point of three numbers (m) is required")):
            status, error = run(request)
            self.assertEqual(status, 1, error)
            self.assertTrue(error.startswith(start), error)
            self.assertEqual(error.count("\n"), 1, error)

    def test_an_unwritable_path_is_named(self):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "missing", "x.svg")
            status, error = run({"drawings": [{"path": path, "format": "svg", "figure": figure()}]})
        self.assertEqual((status, error), (1, f"{path}: cannot be written: No such file or directory\n"))

    def test_a_missing_library_is_named_with_its_package(self):
        for module, kind, content, text in (
                ("matplotlib", "svg", {"figure": figure(chart([RAMP]))}, "figures need python3-matplotlib: sudo apt-get "
                 "install python3-matplotlib\n"),
                ("jinja2", "html", {"page": {"title": "t"}}, "pages need python3-jinja2: sudo apt-get install "
                 "python3-jinja2\n")):
            program = (f"import sys; sys.modules['{module}'] = None; from whirl_twin.drawing.__main__ import main; "
                       "sys.exit(main())")
            request = {"drawings": [{"path": os.devnull, "format": kind, **content}]}
            self.assertEqual(run(request, "-c", program), (1, text))

    def test_importing_the_package_imports_no_library(self):
        program = ("import sys, whirl_twin.drawing; print([m for m in ('numpy', 'matplotlib', 'jinja2') "
                   "if m in sys.modules])")
        done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True)
        self.assertEqual(done.stdout, "[]\n")

    def test_drawing_imports_neither_pyplot_nor_pandas(self):
        program = ("import os, sys; from whirl_twin import drawing; drawing.save({'kind': 'charts', 'charts': []}, os.devnull, "
                   "'svg'); print([m for m in ('matplotlib.pyplot', 'pandas') if m in sys.modules])")
        done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True)
        self.assertEqual(done.stdout, "[]\n")


if __name__ == "__main__":
    unittest.main()
