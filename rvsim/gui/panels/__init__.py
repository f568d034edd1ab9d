"""The docks: each shows one thing or does one thing."""
