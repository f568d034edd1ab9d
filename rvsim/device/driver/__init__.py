"""The driver: one object that talks to an arm on a wire, whichever language it speaks."""
