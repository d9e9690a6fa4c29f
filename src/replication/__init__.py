"""What the steps, figures and documents of the paper and of every study share."""
