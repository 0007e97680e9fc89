"""Starting what signs: the nodes as supervised processes, without `launch`."""
