"""The commands: translate, and those that make and measure models. Each module is one command."""
