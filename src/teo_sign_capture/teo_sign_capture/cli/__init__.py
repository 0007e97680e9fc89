"""The commands that fill the table."""
