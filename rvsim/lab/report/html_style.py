"""The look of the page: a sheet of paper on a grey table, tables with three rules, and the same when it is printed."""

STYLE = """
:root { color-scheme: light; }
body { margin: 0; background: #eef1f5; color: #1d2733; font: 17px/1.5 "STIX Two Text", "Times New Roman",
  "Nimbus Roman", "Liberation Serif", "Tinos", "Noto Naskh Arabic", "Noto Sans Arabic", serif; }
main { max-width: 860px; margin: 32px auto; padding: 56px 72px; background: #fff; box-shadow: 0 1px 6px #22324a33; }
h1, h2, h3, th, figcaption, .kind, .who, .label, .note { font-family: Helvetica, Arial, "Liberation Sans",
  "Nimbus Sans", "Noto Sans Arabic", "DejaVu Sans", sans-serif; }
h1 { font-size: 28px; line-height: 1.2; margin: 4px 0 8px; }
h2 { font-size: 20px; margin: 44px 0 12px; }
h2 .number { color: #2f55d4; margin-inline-end: 6px; }
h3 { font-size: 16px; margin: 28px 0 8px; }
header { border-bottom: 2px solid #1d2733; padding-bottom: 16px; }
.kind { color: #566373; font-size: 13px; letter-spacing: .08em; text-transform: uppercase; margin: 0; }
:lang(ar) .kind { letter-spacing: 0; }
.who { color: #4a5665; margin: 0 0 8px; font-size: 15px; }
p { margin: 10px 0; }
.lead { font-size: 18px; }
.own { border-inline-start: 3px solid #c8d1dd; padding-inline-start: 12px; }
.note { color: #566373; font-size: 13px; line-height: 1.4; }
ul { padding-inline-start: 22px; } ul.marked { list-style: none; padding-inline-start: 0; }
li { margin: 4px 0; }
code { font-family: "DejaVu Sans Mono", Consolas, Menlo, monospace; font-size: 85%; }
.formula { margin-block: 12px; margin-inline: 28px 0; overflow-x: auto; }
.parts { display: inline-block; text-align: left; vertical-align: middle; }
.formula svg { margin: 3px 12px 3px 0; vertical-align: middle; max-width: none; }
.label { display: inline-block; width: 64px; color: #566373; font-size: 13px; }
td svg { vertical-align: middle; }
figure { margin: 24px 0; } figure img, figure > svg { width: 100%; height: auto; display: block; }
figcaption { font-size: 14px; color: #1d2733; margin: 6px 0; }
.scroll { overflow-x: auto; }
table { border-collapse: collapse; min-width: 60%; border-top: 1.6px solid #1d2733; border-bottom: 1.6px solid #1d2733;
  font-size: 15px; font-variant-numeric: tabular-nums; }
th { font-size: 13px; font-weight: 600; border-bottom: .8px solid #1d2733; }
th, td { padding: 4px 7px; white-space: nowrap; vertical-align: baseline; }
td.wide { white-space: normal; }
td.bare { padding-right: calc(7px + .75em); }
tr.total td { border-top: .8px solid #1d2733; }
.left { text-align: start; } .right { text-align: right; } .center { text-align: center; }
.good { color: #00664b; } .warning { color: #8a4b00; } .bad { color: #b3261e; font-weight: 600; }
.muted { color: #566373; }
sub { line-height: 0; }
@media (max-width: 700px) { main { margin: 0; padding: 24px 18px; } .formula { margin-inline-start: 8px; } }
@media print { body { background: #fff; font-size: 10pt; } .math { zoom: .82; } main { box-shadow: none;
  margin: 0; padding: 0; max-width: none; }
  .lead { font-size: 11pt; } table { font-size: 9.5pt; } th, .note { font-size: 8pt; } figcaption { font-size: 8.6pt; }
  figure img { width: 82%; margin-inline: auto; border: .3pt solid #566373; }
  h2, h3 { break-after: avoid; } p, li { orphans: 2; widows: 2; } figure, tr, .formula { break-inside: avoid; } }
@page { size: A4; margin: 22mm; }
"""
