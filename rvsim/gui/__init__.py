"""The screen. Only this floor imports PySide6 and pyqtgraph."""
