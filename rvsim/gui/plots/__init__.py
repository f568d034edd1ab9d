"""Curves over time below the scene, with one cursor in all of them."""
