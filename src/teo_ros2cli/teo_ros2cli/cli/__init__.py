"""The commands and their options, each in a module that is loaded when it is called."""
