"""The commands: their options and output, a module or a room each, loaded when called."""
