"""Help inside the window: pages of resources/help, offline, with typeset formulas and examples to try.

library.py    the pages, their sections and the search through them
document.py   a page as a rich text: formulas as pictures, tables, anchors
examples.py   what a link `rvsim:…` may do, and nothing else
context.py    which page belongs to what has the focus
window.py     the window that shows them
"""
