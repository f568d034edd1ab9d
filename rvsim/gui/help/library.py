"""The pages of resources/help: their titles and sections, and the search through all of them."""

from __future__ import annotations

import re
from functools import cache
from pathlib import Path
from typing import NamedTuple

from rvsim.gui.formula import plain_text
from rvsim.language import language
from rvsim.resources import resource

INDEX = "index"
_HEADING = re.compile(r"(#{1,6}) +(.+)")
_INLINE_MATH = re.compile(r"\$([^$\n]+)\$")
_LINK = re.compile(r"!?\[([^\]]*)\]\([^)]*\)")
_AROUND = 70  # signs that are shown on each side of what was found
_WEIGHTS = (60, 25, 1)  # of a word in the page's title, in the section's, in its text
_SHORTEST_NAME = 4  # of a Greek letter that is looked for too: "pi" is in too many other words


class Section(NamedTuple):
    """A heading with what stands below it, as plain text."""

    page: str
    title: str
    slug: str
    text: str


class HelpPage(NamedTuple):
    """A page: its name is that of its file without ".md"."""

    name: str
    title: str
    source: str
    sections: tuple[Section, ...]


class Hit(NamedTuple):
    """A section in which all words occur, with the text around the first of them."""

    section: Section
    page_title: str
    excerpt: str


def help_pages() -> dict[str, HelpPage]:
    """All pages by name, in the language that is spoken; in English where nobody has translated one."""
    return _pages_in(language().code)


@cache
def _pages_in(code: str) -> dict[str, HelpPage]:
    pages = {file.stem: _page(file) for file in sorted(resource("help").glob("*.md"))}
    own = {file.stem: _page(file) for file in sorted(resource("help", code).glob("*.md"))}
    return {name: _with_anchors(own[name], page) if name in own else page for name, page in pages.items()}


def _page(file: Path) -> HelpPage:
    name, source = file.stem, file.read_text(encoding="utf-8")
    sections = tuple(_sections(name, source))
    return HelpPage(name, sections[0].title if sections else name, source, sections)


def _with_anchors(page: HelpPage, english: HelpPage) -> HelpPage:
    """A translated page with the anchors of the English one, to which the links lead, where their headings match."""
    if len(page.sections) != len(english.sections):
        return page
    pairs = zip(page.sections, english.sections, strict=True)
    return page._replace(sections=tuple(section._replace(slug=known.slug) for section, known in pairs))


def _sections(name: str, source: str) -> list[Section]:
    found: list[tuple[str, list[str]]] = []
    fenced = math = False
    for line in source.splitlines():
        if line.startswith("```"):
            fenced, math = not fenced, line.startswith("```math")
            continue
        heading = None if fenced else _HEADING.fullmatch(line.strip())
        if heading:
            found.append((plain_line(heading[2]), []))
        elif found:
            found[-1][1].append(plain_text(line) if math else plain_line(line))
    return [Section(name, title, slug_of(title), " ".join(" ".join(lines).split())) for title, lines in found]


def plain_line(line: str) -> str:
    """A line of Markdown without its marks."""
    text = _INLINE_MATH.sub(lambda found: plain_text(found[1]), line)
    text = _LINK.sub(r"\1", text)
    text = re.sub(r"^\s*(\||[-*>]\s|\d+\.\s)", "", text)
    return re.sub(r"\*+|`|\\(?=[|*])", "", text).replace("|", " ").replace("---", "").strip()


def slug_of(title: str) -> str:
    """The anchor of a heading: its letters and digits, joined by hyphens."""
    return "-".join(re.findall(r"\w+", title.lower()))


def search(words: str) -> tuple[Hit, ...]:
    """The sections in which every word occurs, also inside longer words; the best first."""
    wanted = [_forms(word) for word in words.casefold().split()]
    if not wanted:
        return ()
    found = []
    for page in help_pages().values():
        for section in page.sections:
            score = _score(page, section, wanted)
            if score:
                found.append((-score, page.title, section))
    return tuple(Hit(section, title, _excerpt(section.text, wanted)) for _, title, section in sorted(found))


def _forms(word: str) -> tuple[str, ...]:
    """A word, and the Greek letter that it names: formulas have σ, not "sigma"."""
    letter = plain_text(f"\\{word}") if word.isalpha() and len(word) >= _SHORTEST_NAME else ""
    return (word, letter.casefold()) if len(letter) == 1 else (word,)


def _score(page: HelpPage, section: Section, wanted: list[tuple[str, ...]]) -> int:
    """0 when a word is missing; a word counts more in a title."""
    texts = [text.casefold() for text in (page.title, section.title, section.text)]
    total = 0
    for forms in wanted:
        counts = [sum(map(text.count, forms)) for text in texts]
        points = sum(weight * min(count, 5) for weight, count in zip(_WEIGHTS, counts, strict=True))
        if not any(counts[1:]):
            return 0
        total += points
    return total


def _excerpt(text: str, wanted: list[tuple[str, ...]]) -> str:
    low = text.casefold()
    places = [low.find(word) for forms in wanted for word in forms if word in low]
    if not places:
        return text[: 2 * _AROUND] + ("…" if len(text) > 2 * _AROUND else "")
    first, last = max(min(places) - _AROUND, 0), min(places) + _AROUND
    first = text.find(" ", first) + 1 if first else 0
    last = text.rfind(" ", first, last) if last < len(text) else len(text)
    return ("… " if first else "") + text[first:last] + (" …" if last < len(text) else "")
