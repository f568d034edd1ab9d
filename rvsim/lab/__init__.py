"""What both the window and the command line offer: the experiments of the sources."""
