"""The lab report: a document that is a value, and the HTML page that is made of it. It is painted by the window."""

from rvsim.lab.report.document import PARTS, Part, build, parts_of, title_of
from rvsim.lab.report.html import Artist, html_page
from rvsim.lab.report.study import Study
from rvsim.lab.report.values import Cover, Document

__all__ = ["PARTS", "Artist", "Cover", "Document", "Part", "Study", "build", "html_page", "parts_of", "title_of"]
