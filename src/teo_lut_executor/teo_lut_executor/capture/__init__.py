"""From what a person's hands did to signs that TEO can make."""
