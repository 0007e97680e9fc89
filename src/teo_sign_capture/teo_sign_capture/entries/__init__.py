"""From takes to entries of the table.

One take, several takes, checks by the planner, evidence, pictures, batches.
"""
