"""The lab report on paper and on the screen: formulas, curves and scenes drawn, pages set, files written."""
