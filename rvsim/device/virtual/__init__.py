"""The virtual arm: servos that lag, sag and stick, behind a board that speaks the real one's language. No clock."""
