"""The wire: an arm of hobby servos, real or virtual. Codecs (bytes ↔ commands), driver, virtual arm, links."""
