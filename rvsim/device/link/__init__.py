"""How bytes get to the arm: paced at the baud rate, in this process, through a pseudo-terminal, or over TCP."""
