"""The systems that the translator is measured beside."""
