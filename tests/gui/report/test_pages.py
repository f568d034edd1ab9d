"""Strips on pages: nothing is lost, cut or parted from what it belongs to, and no page is empty without need."""

from __future__ import annotations

from itertools import pairwise

from hypothesis import given
from hypothesis import strategies as st

from rvsim import load_robot
from rvsim.gui.report.pages import Page, fill, paginated
from rvsim.gui.report.pdf import HEIGHT, Sheets
from rvsim.gui.report.strips import Strip
from rvsim.lab import default_experiment
from rvsim.lab.repairs import motion_of, path_of
from rvsim.lab.report import Cover, Study, build
from rvsim.motion import track

TALL = 100.0


def strip(height: float, **more: object) -> Strip:
    return Strip(height, lambda *_: None, **more)


def figure(height: float, kind: str = "figure") -> Strip:
    return strip(height, above=4.0, below=4.0, floats=kind, smaller=((strip(0.8 * height, floats=kind),),))


def section(lines: list[float]) -> list[Strip]:
    title = strip(8.0, above=9.0, keep=True, begins=True)
    return [title, *(strip(height, above=3.0, goes_on=number > 0) for number, height in enumerate(lines))]


HEIGHTS = st.floats(4.0, 30.0)
BLOCKS = st.one_of(
    st.lists(HEIGHTS, min_size=1, max_size=9).map(section),
    st.lists(HEIGHTS, min_size=1, max_size=9).map(lambda heights: [strip(height, above=3.0) for height in heights]),
    st.floats(10.0, 90.0).map(lambda height: [figure(height)]),
    st.floats(10.0, 60.0).map(lambda height: [figure(height, "table")]),
)
DOCUMENTS = st.lists(BLOCKS, min_size=1, max_size=12).map(lambda blocks: [each for block in blocks for each in block])


def found(pages: tuple[Page, ...], kind: str) -> list[Strip]:
    return [placed.strip for page in pages for placed in page if placed.strip.floats == kind]


def stands_for(placed: Strip, meant: Strip) -> bool:
    return placed is meant or any(placed is other[0] for other in meant.smaller)


@given(DOCUMENTS)
def test_every_strip_stands_once_and_in_the_order_of_its_kind(strips: list[Strip]) -> None:
    pages = paginated(strips, TALL)
    for kind in ("", "figure", "table"):
        placed, meant = found(pages, kind), [each for each in strips if each.floats == kind]
        assert len(placed) == len(meant)
        assert all(map(stands_for, placed, meant))


@given(DOCUMENTS)
def test_nothing_leaves_its_page_or_lies_on_another(strips: list[Strip]) -> None:
    for page in paginated(strips, TALL):
        assert page[0].y == 0.0
        bottoms = [y + each.height for y, each in page]
        assert bottoms[-1] <= TALL
        assert all(bottom <= y for bottom, (y, _) in zip(bottoms, page[1:], strict=False))


@given(DOCUMENTS)
def test_no_title_ends_a_page_and_no_figure_parts_what_belongs_together(strips: list[Strip]) -> None:
    for page in paginated(strips, TALL):
        assert not page[-1].strip.keep
        assert not any(before.strip.floats and after.strip.goes_on for before, after in pairwise(page))


@given(DOCUMENTS)
def test_a_page_is_half_empty_only_where_what_comes_next_does_not_fit(strips: list[Strip]) -> None:
    pages = paginated(strips, TALL)
    for page, following in pairwise(pages):
        free = (1.0 - fill(page, TALL)) * TALL
        assert free < 0.4 * TALL or least(following) > free - 13.0  # so much are the spaces above and below


def least(page: Page) -> float:
    """How high what begins a page is at least: a title with a line, or a figure made smaller."""
    first = page[0].strip
    if first.keep:
        return page[1].y + page[1].strip.height
    return 0.8 * first.height if first.smaller else first.height


def test_a_table_that_goes_on_has_its_head_again() -> None:
    head = strip(10.0)
    rows = [strip(20.0, again=(head,)) for _ in range(20)]
    pages = paginated([head._replace(keep=True), *rows], TALL)
    assert len(pages) > 3
    assert all(page[0].strip.height == 10.0 for page in pages)


def test_a_figure_that_does_not_fit_waits_while_the_text_goes_on() -> None:
    waiting = strip(60.0, floats="figure")
    pages = paginated([strip(50.0), waiting, *(strip(10.0) for _ in range(8))], TALL)
    assert [len(page) for page in pages] == [6, 4]
    assert pages[1][0].strip is waiting


def test_a_figure_is_made_smaller_where_it_then_fits() -> None:
    pages = paginated([strip(30.0), figure(75.0)], TALL)
    assert [placed.strip.height for placed in pages[0]] == [30.0, 60.0]


def test_a_section_begins_neither_at_the_foot_of_a_page_nor_far_before_the_figures_of_the_last_one() -> None:
    title = strip(10.0, keep=True, begins=True)
    pages = paginated([strip(88.0), title, strip(2.0)], TALL)
    assert [len(page) for page in pages] == [1, 2]
    figures = [strip(60.0, floats="figure") for _ in range(2)]
    pages = paginated([strip(50.0), *figures, title, strip(10.0)], TALL)
    assert [page[0].strip.floats for page in pages] == ["", "figure", "figure"]
    assert pages[2][1].strip.begins


def test_a_table_does_not_wait_for_a_figure() -> None:
    waiting, small = strip(60.0, floats="figure"), strip(20.0, floats="table")
    pages = paginated([strip(50.0), waiting, small, small], TALL)
    assert [[placed.strip.floats for placed in page] for page in pages] == [["", "table", "table"], ["figure"]]


def test_spaces_are_narrower_where_a_last_page_would_have_a_line_only() -> None:
    lines = [strip(9.0, above=1.4) for _ in range(19)]
    pages = paginated(lines, TALL)
    assert [len(page) for page in pages] == [10, 9]
    assert max(fill(page, TALL) for page in pages) <= 1.0


def test_the_pages_of_a_report_are_full(qapp: object) -> None:
    experiment = default_experiment(load_robot("rv-m1"))
    tracking = track(experiment.robot, path_of("line", experiment), near=experiment.q)
    study = Study(experiment, tracking, motion_of(tracking, experiment))
    sheets = Sheets(build(study, Cover("Laboratory 3"), {"robot", "torques", "path", "motion"}))
    list(sheets.lay_out())
    fills = [fill(page, HEIGHT) for page in sheets.pages]
    assert min(fills[:-1]) > 0.75
    assert fills[-1] > 0.1
