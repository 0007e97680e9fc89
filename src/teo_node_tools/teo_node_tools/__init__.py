"""What every node does alike: show its parameters, and run until it is told to end."""
