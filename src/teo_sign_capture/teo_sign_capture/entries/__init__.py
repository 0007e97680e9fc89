"""From takes to entries of the table: gates, evidence, pictures, batches."""
