"""Rotations and transforms. No robots here."""
