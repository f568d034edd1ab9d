"""The language of the SSC-32 and SSC-32U servo controllers, both sides of it, without any input or output."""
