"""The two ways to draw a scene: OpenGL through pyqtgraph, and QPainter."""
