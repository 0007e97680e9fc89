"""The commands of the translator."""
