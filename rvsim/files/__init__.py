"""The disk: robot files."""
