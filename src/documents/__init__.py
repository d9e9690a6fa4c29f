"""What becomes of the results: figures, notebooks, verdicts, documents, and what is published."""
