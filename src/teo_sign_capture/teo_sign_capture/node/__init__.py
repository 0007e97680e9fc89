"""The node that captures a sign live."""
