"""The parts of the format of session files: text, places, kinds of value, tables, migrations."""
