"""Where the arm goes and when: path (geometry), tracking (path to joints), time law and trajectory."""
