"""What the packages share: parameters in a table, running a node, atomic files."""
